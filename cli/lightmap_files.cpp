// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lightmap_files.h>

#include <algorithm>

#include <tetralight/base/file.h>
#include <tetralight/base/half.h>
#include <tetralight/base/json/check_metadata.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/lightmap_report.h>
#include <tetralight/lightmap/blend_lightmaps.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/lightmap/relight_lightmaps.h>
#include <tetralight/pipeline/lightmap_part.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::cli {
namespace {

/// Counts over all texels.
struct TexelFacts {
    size_t covered = 0;
    TexelErrors errors;
};

TexelFacts texel_facts(const LightmapsView& maps) {
    TexelFacts facts;
    for (const IrradianceTexel& texel : maps.irradiance) facts.covered += texel.coverage != 0;
    std::vector<float> errors;
    for (const uint16_t half : maps.error) {
        if (half != 0) errors.push_back(float_from_half(half));
    }
    if (errors.empty()) return facts;
    const auto middle = errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    facts.errors.median = *middle;
    facts.errors.worst = *std::ranges::max_element(errors);
    return facts;
}

size_t object_count(const LightmapsView& maps) {
    return static_cast<size_t>(std::ranges::count_if(
        maps.rectangles, [](const auto& place) { return place.page != kNoIndex; }));
}

Json layers_json(const LightmapsView& maps) {
    Json layers = Json::array();
    const auto names = split_names(maps.layer_names);
    for (size_t i = 0; i < names.size() && i < maps.layers.size(); ++i) {
        layers.push_back({{"name", names[i]}, {"weight", maps.layers[i].weight}});
    }
    return layers;
}

std::string layers_text(const LightmapsView& maps) {
    std::string line;
    const auto names = split_names(maps.layer_names);
    for (size_t i = 0; i < names.size() && i < maps.layers.size(); ++i) {
        line += str_cat(line.empty() ? "" : ", ", printable(std::string(names[i])), " ",
                        maps.layers[i].weight);
    }
    return line;
}

std::string pages_text(const LightmapsView& maps) {
    return str_cat(counted(maps.info.page_count, "page"), " of ", maps.info.page_size, " x ",
                   maps.info.page_size, ", ", counted(object_count(maps), "object"));
}

Json facts_json(const std::string& path, const LightmapsView& maps) {
    const TexelFacts facts = texel_facts(maps);
    Json json{{"file", path},
              {"pages", maps.info.page_count},
              {"page_size", maps.info.page_size},
              {"texels_per_meter", maps.info.texels_per_meter},
              {"objects", object_count(maps)},
              {"texels", maps.texel_count()},
              {"covered_texels", facts.covered},
              {"standard_error", to_json(facts.errors)},
              {"has_directions", !maps.light.empty()},
              {"mixed_lighting", name_of(maps.info.mixed_lighting)},
              {"has_shadow_mask", !maps.shadow_mask.empty()},
              {"ambient_occlusion_distance", maps.info.ambient_occlusion_distance},
              {"layers", layers_json(maps)}};
    json["made_with"] = maps.metadata.empty() ? Json() : Json::parse(maps.metadata);
    return json;
}

/// The file, with its metadata checked.
Result<LightmapFile> open_checked(const std::string& path) {
    auto file = open_lightmap_file(path);
    if (!file) return file;
    if (auto status = check_metadata(file->view().metadata); !status) {
        return status.error().in(shown_path(path));
    }
    return file;
}

/// Parts have no light yet.
Status refuse_part(const LightmapFile& file, const std::string& path, const char* setting) {
    if (!is_part(file)) return Ok{};
    return Error{ErrorCode::InvalidArgument, setting, path,
                 path + ": is a part of a bake; merge its parts first"};
}

}  // namespace

Status check_output_kind(const std::string& input, const std::string& output,
                         std::string_view contents) {
    struct Kind {
        std::string_view contents, extension;
    };

    constexpr Kind kKinds[] = {
        {"probes", ".probes"}, {"lightmaps", ".lightmaps"}, {"reflection probes", ".ktx2"}};
    for (const Kind& kind : kKinds) {
        if (kind.contents == contents || !output.ends_with(kind.extension)) continue;
        return Error{ErrorCode::InvalidArgument, "output", output,
                     str_cat(input, ": contains no ", kind.contents,
                             "; give the output another name than ", output)};
    }
    return Ok{};
}

Result<std::optional<LightmapFile>> open_lightmaps(const std::string& path) {
    if (path.empty()) return std::optional<LightmapFile>();
    auto file = open_lightmap_file(path);
    if (!file) return file.error();
    if (auto status = refuse_part(*file, path, "lightmaps"); !status) return status.error();
    return std::optional(std::move(*file));
}

Error in_light_files(const Error& error, const LightPaths& paths) {
    // Lightmaps that do not fit the probes.
    const bool is_of_lightmaps = error.field == "lightmaps";
    if (!is_of_lightmaps) return error.in(shown_path(paths.scene));
    return error.in(str_cat(shown_path(paths.lightmaps), " and ", shown_path(paths.volume)));
}

bool is_lightmap_file(const std::string& path) {
    const auto file = MappedFile::open(path);
    return file && tetralight::is_lightmap_file(file->bytes());
}

Status show_lightmaps(const std::string& path, const CommonOptions& common) {
    const auto file = open_checked(path);
    if (!file) return file.error();
    const LightmapsView& maps = file->view();
    const TexelFacts facts = texel_facts(maps);
    std::string text =
        str_cat(printable(path), ": ", pages_text(maps), ", ", grouped(facts.covered), " of ",
                grouped(maps.texel_count()), " texels have light\n  ", maps.info.texels_per_meter,
                " texels per metre; ", to_text(facts.errors));
    Json json = facts_json(path, maps);
    if (is_part(*file)) {
        const auto part = read_lightmap_part(path);
        if (!part) return part.error();
        const PlaceRange& range = part->partial.range;
        const size_t count = part->prepared.baked.size();
        json["part"] = {
            {"range", {range.begin, range.end}}, {"step", range.step}, {"all_texels", count}};
        text = str_cat(printable(path), ": part of a bake of lightmaps, texels ", name_of(range),
                       " of ", grouped(count), "\n  ", maps.info.texels_per_meter,
                       " texels per metre, pages of ", maps.info.page_size, " x ",
                       maps.info.page_size);
    }
    if (!maps.layers.empty()) text += "\n  layers " + layers_text(maps);
    if (maps.info.mixed_lighting != MixedLighting::Indirect)
        text += str_cat("\n  mixed lighting ", name_of(maps.info.mixed_lighting));
    if (maps.info.ambient_occlusion_distance > 0.0f)
        text += str_cat("\n  ambient occlusion up to ", maps.info.ambient_occlusion_distance, " m");
    if (!maps.metadata.empty()) text += "\n  made with " + printable(std::string(maps.metadata));
    common.print(json, text);
    return Ok{};
}

Status validate_lightmaps(const std::string& path, const CommonOptions& common) {
    const auto file = open_checked(path);
    if (!file && (can_retry(file.error().code) || file.error().code == ErrorCode::NotFound)) {
        return file.error();
    }
    if (!file) {
        const std::string problem = error_json(file.error())["message"];
        return with_report(
            file.error(),
            {{"file", path}, {"is_valid", false}, {"problems", std::vector<std::string>{problem}}});
    }
    Json json = facts_json(path, file->view());
    json["is_valid"] = true;
    json["problems"] = Json::array();
    common.print(
        json, str_cat(printable(path), ": valid, ",
                      is_part(*file) ? "a part of a bake of lightmaps" : pages_text(file->view())));
    return Ok{};
}

Status relight_lightmap_file(const std::string& path, const std::string& output,
                             const LightmapChange& change, const CommonOptions& common) {
    const auto file = open_checked(path);
    if (!file) return file.error();
    if (auto status = refuse_part(*file, path, "volume"); !status) return status;
    Lightmaps maps = copy_lightmaps(file->view());
    std::vector<LayerWeight> weights;
    for (const auto& [layer, weight] : change.weights) weights.push_back({layer, weight});
    if (!weights.empty()) {
        if (auto status = relight_lightmaps(maps, weights); !status) {
            return status.error().in(path);
        }
    }
    if (!change.blend_path.empty()) {
        const auto other = open_lightmap_file(change.blend_path);
        if (!other) return other.error();
        auto blended = blend_lightmaps(maps.view(), other->view(), change.blend_share);
        if (!blended) return blended.error().in(change.blend_path);
        maps = std::move(*blended);
    }
    if (auto status = write_lightmap_file(output, maps.view()); !status) return status;
    const std::string layers = layers_text(maps.view());
    common.report(
        output,
        {{"output", output},
         {"standard_error", to_json(texel_facts(maps.view()).errors)},
         {"layers", layers_json(maps.view())}},
        str_cat(output, ": ", pages_text(maps.view()), layers.empty() ? "" : ", layers " + layers));
    return Ok{};
}

}  // namespace tetralight::cli
