// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_part.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <tetralight/bake/image/fraction_byte.h>
#include <tetralight/bake/lightmap/mapped_texels.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/part_sections.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/section_error.h>

namespace tetralight {
namespace {

using detail::element_error;
using detail::section_error;

/// Section "packings": the sizes of a `TexelMap`.
struct PackingSize {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t texel_count = 0;
};

/// Section "texel_states".
enum class TexelState : uint8_t { InsideGeometry, LeftOut, Baked };

/// Section "seams": both sides of a `Seam`.
using SeamEdges = std::array<PageEdge, 2>;

static_assert(sizeof(SeamEdges) == 40 && std::is_trivially_copyable_v<SeamEdges>);

/// What part files keep of maps and texels, as arrays.
struct PartArrays {
    std::vector<PackingSize> packings;
    std::vector<uint32_t> footprints;  ///< `TexelMap::charts`
    std::vector<uint32_t> covered;     ///< index of each of `TexelMap::texels`
    std::vector<TexelState> states;    ///< one a texel, in the order of `LightmapTexels`
    std::vector<uint8_t> validity;     ///< the same, times 255
    std::vector<SeamEdges> seams;

    explicit PartArrays(const PreparedLightmaps& prepared) {
        for (const TexelMap& map : prepared.maps) {
            const auto count = static_cast<uint32_t>(map.texels.size());
            packings.push_back({map.width, map.height, count});
            footprints.insert(footprints.end(), map.charts.begin(), map.charts.end());
            for (const TexelMap::Texel& texel : map.texels) covered.push_back(texel.index);
        }
        for (size_t i = 0; i < prepared.texels.validity.size(); ++i) {
            const bool is_valid = prepared.texels.is_valid(i);
            states.push_back(is_valid ? TexelState::LeftOut : TexelState::InsideGeometry);
            validity.push_back(fraction_byte(prepared.texels.validity[i]));
        }
        for (const uint32_t texel : prepared.baked) states[texel] = TexelState::Baked;
        for (const Seam& seam : prepared.seams) seams.push_back(SeamEdges{seam.first, seam.second});
    }

    explicit PartArrays(const PartSections& sections)
        : packings(sections.read<PackingSize>("packings")),
          footprints(sections.read<uint32_t>("footprints")),
          covered(sections.read<uint32_t>("covered_texels")),
          states(sections.read<TexelState>("texel_states")),
          validity(sections.read<uint8_t>("texel_validity")),
          seams(sections.read<SeamEdges>("seams")) {}
};

/// Fills the members of a part from its file.
class PartReader {
  public:
    PartReader(const LightmapFile& file, LightmapPartFile& part)
        : file_(file), sections_(file), arrays_(sections_), part_(part), prepared_(part.prepared) {}

    [[nodiscard]] Status run() {
        constexpr const char* kWriter = "lightmap --texels";
        const auto info = sections_.info(kWriter);
        if (!info) return info.error();
        if (file_.view().info.page_count > 0) return not_a_part(kWriter);
        part_.partial.range = info->range();
        prepared_.key = info->key;
        prepared_.settings.bake = info->bake_settings();
        prepared_.settings.is_unfiltered = info->is_unfiltered != 0;
        for (const auto read : {&PartReader::read_lightmaps, &PartReader::read_maps,
                                &PartReader::read_texels, &PartReader::read_seams}) {
            if (auto status = (this->*read)(); !status) return status;
        }
        return read_light();
    }

  private:
    /// Each page has a rectangle, so that their number bounds that of the pages.
    [[nodiscard]] Status read_lightmaps() {
        Lightmaps& maps = prepared_.lightmaps;
        maps = copy_lightmaps(file_.view());
        maps.rectangles = sections_.read<LightmapRectangle>("part_rectangles");
        for (const char letter : sections_.read<char>("part_names")) maps.instance_names += letter;
        uint32_t& page_count = maps.info.page_count;
        for (size_t i = 0; i < maps.rectangles.size(); ++i) {
            const uint32_t page = maps.rectangles[i].page;
            if (page == kNoIndex) continue;
            if (page >= maps.rectangles.size()) {
                return element_error("part_rectangles", i,
                                     str_cat("page ", page, " is out of range"));
            }
            page_count = std::max(page_count, page + 1);
        }
        const uint64_t count = maps.view().texel_count();
        if (count == 0 || count >= kNoIndex) {
            return section_error("part_rectangles", str_cat("its pages have ", count, " texels"));
        }
        maps.irradiance.resize(count);
        if (auto status = verify(maps.view()); !status) return status;
        maps.irradiance.clear();
        const auto names = split_names(maps.layer_names);
        prepared_.settings.bake.plan.has_rest = !names.empty() && names.back() == "rest";
        prepared_.settings.bake.plan.layer_count =
            static_cast<uint32_t>(names.size() - (prepared_.settings.bake.plan.has_rest ? 1 : 0));
        prepared_.settings.bake.plan.has_occlusion = prepared_.has_shadow_mask();
        prepared_.settings.bake.plan.ambient_occlusion_distance =
            maps.info.ambient_occlusion_distance;
        return Ok{};
    }

    [[nodiscard]] Status read_maps() {
        const Lightmaps& maps = prepared_.lightmaps;
        if (arrays_.packings.size() != maps.meshes.size()) {
            return section_error("packings", str_cat(arrays_.packings.size(), " elements for ",
                                                     maps.meshes.size(), " meshes"));
        }
        size_t footprint = 0, covered = 0;
        for (size_t i = 0; i < arrays_.packings.size(); ++i) {
            const auto& [width, height, texel_count] = arrays_.packings[i];
            const uint32_t largest = maps.info.page_size;
            const size_t size = size_t{width} * height;
            const bool is_sound = width <= largest && height <= largest &&
                                  size <= arrays_.footprints.size() - footprint &&
                                  texel_count <= arrays_.covered.size() - covered;
            if (!is_sound) return element_error("packings", i, "is out of range");
            TexelMap& map = prepared_.maps.emplace_back();
            map.width = width;
            map.height = height;
            const auto charts = std::span(arrays_.footprints).subspan(footprint, size);
            map.charts.assign(charts.begin(), charts.end());
            for (const uint32_t index : std::span(arrays_.covered).subspan(covered, texel_count))
                map.texels.push_back({index, 0, 0});
            footprint += size;
            covered += texel_count;
            if (auto status = check_map(map, i); !status) return status;
        }
        if (footprint != arrays_.footprints.size())
            return section_error("footprints", "has more elements than its packings");
        if (covered == arrays_.covered.size()) return Ok{};
        return section_error("covered_texels", "has more elements than its packings");
    }

    /// Counts the charts, too.
    [[nodiscard]] Status check_map(const TexelMap& map, size_t packing) {
        size_t begin = 0;
        for (const TexelMap::Texel& texel : map.texels) {
            if (texel.index < begin || texel.index >= map.charts.size()) {
                return section_error(
                    "covered_texels",
                    str_cat("texel ", texel.index, " of packing ", packing, " is out of range"));
            }
            begin = size_t{texel.index} + 1;
        }
        size_t chart_count = 0;
        for (const uint32_t chart : map.charts) {
            if (chart != kNoIndex) chart_count = std::max(chart_count, size_t{chart} + 1);
        }
        prepared_.report.chart_count += chart_count;
        return Ok{};
    }

    [[nodiscard]] Status read_texels() {
        auto& first_texel = prepared_.texels.first_texel;
        size_t count = 0;
        for (size_t i = 0; i < prepared_.lightmaps.rectangles.size(); ++i) {
            const LightmapRectangle& place = prepared_.lightmaps.rectangles[i];
            first_texel.push_back(static_cast<uint32_t>(count));
            if (place.page == kNoIndex) continue;
            if (place.mesh >= prepared_.maps.size())
                return element_error("part_rectangles", i, "has no packing");
            const TexelMap& map = prepared_.maps[place.mesh];
            if (map.width != place.width || map.height != place.height)
                return element_error("part_rectangles", i, "has another size than its packing");
            count += map.texels.size();
        }
        if (arrays_.states.size() != count || arrays_.validity.size() != count || count > kNoIndex)
            return section_error("texel_states", str_cat(arrays_.states.size(), " elements and ",
                                                         arrays_.validity.size(),
                                                         " of validity for ", count, " texels"));
        first_texel.push_back(static_cast<uint32_t>(count));
        for (uint32_t i = 0; i < count; ++i) {
            if (arrays_.states[i] > TexelState::Baked)
                return element_error("texel_states", i, "is unknown");
            if (arrays_.states[i] == TexelState::Baked) prepared_.baked.push_back(i);
            prepared_.report.invalid_count += arrays_.states[i] == TexelState::InsideGeometry;
            prepared_.texels.validity.push_back(static_cast<float>(arrays_.validity[i]) / 255.0f);
        }
        prepared_.report.texel_count = count;
        prepared_.report.baked_count = prepared_.baked.size();
        return Ok{};
    }

    [[nodiscard]] Status read_seams() {
        const LightmapInfo& info = prepared_.lightmaps.info;
        const auto is_inside = [&](const glm::vec2& place) {
            const auto size = static_cast<float>(info.page_size);
            return place.x >= 0.0f && place.x <= size && place.y >= 0.0f && place.y <= size;
        };
        for (size_t i = 0; i < arrays_.seams.size(); ++i) {
            for (const PageEdge& edge : arrays_.seams[i]) {
                if (edge.page < info.page_count && is_inside(edge.begin) && is_inside(edge.end))
                    continue;
                return element_error("seams", i, "is outside of the pages");
            }
            Seam& seam = prepared_.seams.emplace_back();
            seam.first = arrays_.seams[i][0];
            seam.second = arrays_.seams[i][1];
        }
        prepared_.report.seam_count = prepared_.seams.size();
        return Ok{};
    }

    [[nodiscard]] Status read_light() {
        TexelBake& bake = part_.partial;
        bake.accumulators = sections_.read<ProbeAccumulator>("tallies");
        bake.rows = sections_.read<double>("split_rows");
        bake.normals = sections_.read<glm::vec3>("texel_normals");
        const BakeSettings& settings = prepared_.settings.bake;
        const size_t row_size = LightGroupLayout(settings.plan).size();
        const Status status = check_sums({bake.range, bake.accumulators, bake.rows, row_size},
                                         {"texel", prepared_.baked.size()}, settings);
        if (!status) return status;
        if (bake.normals.size() != bake.range.count()) {
            return section_error("texel_normals", str_cat(bake.normals.size(), " elements for ",
                                                          bake.range.count(), " texels"));
        }
        for (size_t i = 0; i < bake.normals.size(); ++i) {
            if (!is_finite(bake.normals[i]))
                return element_error("texel_normals", i, "is not finite");
        }
        return read_mapped_normals(bake);
    }

    [[nodiscard]] Status read_mapped_normals(TexelBake& bake) const {
        bake.mapped_normals = sections_.read<glm::vec3>("mapped_normals");
        const size_t count = bake.mapped_normals.size();
        if (count != 0 && count != kMappedNormals * bake.range.count()) {
            return section_error("mapped_normals",
                                 str_cat(count, " elements for ", bake.range.count(), " texels"));
        }
        for (size_t i = 0; i < count; ++i) {
            if (!is_finite(bake.mapped_normals[i]))
                return element_error("mapped_normals", i, "is not finite");
        }
        return Ok{};
    }

    const LightmapFile& file_;
    const PartSections sections_;
    const PartArrays arrays_;
    LightmapPartFile& part_;
    PreparedLightmaps& prepared_;
};

}  // namespace

bool is_part(const LightmapFile& file) noexcept {
    return PartSections(file).is_part();
}

Status write_lightmap_part(const std::string& path, const PreparedLightmaps& prepared,
                           const TexelBake& partial) {
    TETRALIGHT_ASSERT(partial.accumulators.size() == partial.range.count(),
                      "one accumulator for each texel of the range");
    PartInfo info(prepared.key, partial.range, prepared.settings.bake);
    info.is_unfiltered = prepared.settings.is_unfiltered ? 1 : 0;
    const std::vector<PartInfo> infos{info};
    const PartArrays arrays(prepared);
    const Lightmaps& maps = prepared.lightmaps;
    const std::vector<char> names(maps.instance_names.begin(), maps.instance_names.end());
    const std::vector<ExtraSection> sections{section_of("part", infos),
                                             section_of("part_rectangles", maps.rectangles),
                                             section_of("part_names", names),
                                             section_of("packings", arrays.packings),
                                             section_of("footprints", arrays.footprints),
                                             section_of("covered_texels", arrays.covered),
                                             section_of("texel_states", arrays.states),
                                             section_of("texel_validity", arrays.validity),
                                             section_of("seams", arrays.seams),
                                             section_of("tallies", partial.accumulators),
                                             section_of("split_rows", partial.rows),
                                             section_of("texel_normals", partial.normals),
                                             section_of("mapped_normals", partial.mapped_normals)};
    LightmapsView view = maps.view();
    view.info.page_count = 0;
    view.rectangles = {};
    view.instance_names = {};
    return write_lightmap_file(path, view, sections);
}

Result<LightmapPartFile> read_lightmap_part(const std::string& path) {
    const auto file = open_lightmap_file(path);
    if (!file) return file.error();
    LightmapPartFile part;
    part.path = path;
    if (auto status = PartReader(*file, part).run(); !status) return status.error().in(path);
    return part;
}

}  // namespace tetralight
