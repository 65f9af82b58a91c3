// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/lightmap_layout.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <tetralight/bake/lightmap/mesh_shape.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/charts/authored_uvs.h>

namespace tetralight {
namespace {

constexpr uint32_t kMinPageSize = 16, kMaxPageSize = 16384;

Status check(const LightmapLayoutSettings& settings) {
    if (!std::isfinite(settings.texels_per_meter) || !(settings.texels_per_meter > 0.0)) {
        return Error{ErrorCode::InvalidArgument, "texels_per_meter",
                     str_cat(settings.texels_per_meter),
                     str_cat("texels_per_meter: ", settings.texels_per_meter,
                             " is not a finite number above 0")};
    }
    if (settings.page_size < kMinPageSize || settings.page_size > kMaxPageSize) {
        return Error{ErrorCode::InvalidArgument, "page_size", str_cat(settings.page_size),
                     str_cat("page_size: ", settings.page_size, " is not from ", kMinPageSize,
                             " to ", kMaxPageSize, " texels")};
    }
    return Ok{};
}

/// A mesh in one shape.
using UnwrapKey = std::pair<uint32_t, MeshShape>;

/// A mesh in one shape at one density, texels per metre of the shape.
using PackingKey = std::tuple<uint32_t, MeshShape, float>;

/// The density of an instance. Rotations change its last bits, which do not count.
float density_of(const MeshInstance& instance, double size, double texels_per_meter) {
    const double density = texels_per_meter * double{instance.lightmap.scale} * size;
    int exponent = 0;
    const double mantissa = std::frexp(density, &exponent);
    return static_cast<float>(std::ldexp(std::round(mantissa * 0x1p20) * 0x1p-20, exponent));
}

/// The instances of a scene by what they share.
struct Work {
    std::vector<UnwrapKey> unwrap_keys;
    std::vector<PackingKey> packing_keys;
    std::vector<uint32_t> packing_of;      ///< one an instance, or kNoIndex
    std::vector<uint32_t> first_instance;  ///< of each packing, for messages
    std::vector<uint32_t> unwrap_of;       ///< one a packing
};

template <class Key>
uint32_t index_of(std::map<Key, uint32_t>& indices, std::vector<Key>& keys, const Key& key) {
    const auto [found, is_new] = indices.emplace(key, static_cast<uint32_t>(keys.size()));
    if (is_new) keys.push_back(key);
    return found->second;
}

Work work_of(const Scene& scene, double texels_per_meter) {
    Work work;
    std::map<UnwrapKey, uint32_t> unwraps;
    std::map<PackingKey, uint32_t> packings;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const MeshInstance& instance = scene.instances[i];
        work.packing_of.push_back(kNoIndex);
        if (!takes_lightmap(scene, instance)) continue;
        const auto [shape, size] = shape_of(instance);
        const PackingKey key{instance.mesh, shape, density_of(instance, size, texels_per_meter)};
        work.packing_of.back() = index_of(packings, work.packing_keys, key);
        if (work.packing_keys.size() == work.first_instance.size()) continue;
        work.first_instance.push_back(i);
        work.unwrap_of.push_back(index_of(unwraps, work.unwrap_keys, {instance.mesh, shape}));
    }
    return work;
}

std::string name_of(const Scene& scene, uint32_t instance) {
    const std::string& name = scene.instances[instance].name;
    return name.empty() ? str_cat("object ", instance) : str_cat("object \"", name, "\"");
}

/// Charts, and what is wrong with authored UVs.
struct Unwrapped {
    Unwrap charts;
    UvCheck check;

    [[nodiscard]] bool is_bad() const {
        constexpr double kLostPart = 1e-3;  // slivers
        return check.overlap_area > 0.0 || check.outside_count > 0 ||
               check.lost_fraction > kLostPart;
    }
};

Unwrapped unwrap_mesh(const Scene& scene, const UnwrapKey& key,
                      const LightmapLayoutSettings& settings) {
    const Mesh& mesh = scene.meshes[key.first];
    const std::vector<glm::vec3> positions = shaped_positions(mesh.positions, key.second);
    const ChartMesh shaped{positions, mesh.indices};
    Unwrapped result;
    if (settings.uvs == LightmapUvs::Unwrap || mesh.uvs[1].empty()) {
        result.charts = unwrap(shaped, settings.unwrap);
        return result;
    }
    result.check = check_uvs(shaped, mesh.uvs[1]);
    const bool is_kept = settings.uvs == LightmapUvs::Keep || !result.is_bad();
    result.charts = is_kept ? keep_uvs(shaped, mesh.uvs[1]) : unwrap(shaped, settings.unwrap);
    return result;
}

/// The number to three significant digits.
std::string three_digits(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", value);
    return buffer;
}

std::string uv_warning(const Scene& scene, uint32_t instance, const Unwrapped& unwrapped,
                       LightmapUvs uvs) {
    const UvCheck& check = unwrapped.check;
    std::vector<std::string> problems;
    if (check.overlap_area > 0.0) {
        problems.push_back(str_cat("overlaps itself on ", three_digits(check.overlap_area),
                                   " of the ", three_digits(check.area),
                                   " that its triangles cover (1 = the square from 0 to 1)"));
    }
    if (check.outside_count > 0)
        problems.push_back(str_cat("leaves 0 to 1 at ", check.outside_count, " corners"));
    if (check.lost_fraction > 0.0) {
        problems.push_back(str_cat("has no area on ", three_digits(100.0 * check.lost_fraction),
                                   " % of the surface, which gets no texels of its own"));
    }
    std::string text = name_of(scene, instance) + ": TEXCOORD_1 ";
    for (size_t i = 0; i < problems.size(); ++i)
        text += (i == 0 ? "" : i + 1 < problems.size() ? ", " : ", and ") + problems[i];
    return text + (uvs == LightmapUvs::Repair ? "; the mesh is unwrapped anew"
                                              : "; the lightmap uses it unchanged");
}

/// The largest part of a density, in (0, 1), at which charts fit into a page; 0 if none is found.
double fitting_part(const Unwrap& charts, float density, uint32_t page_size) {
    const auto fits = [&](double part) {
        const auto lower = static_cast<float>(part * double{density});
        return lower > 0.0f && pack_charts(charts, {lower, page_size});
    };
    constexpr int kHalvings = 24, kSteps = 6;
    double part = 0.5;
    for (int i = 0; !fits(part); part *= 0.5) {
        if (++i == kHalvings) return 0.0;
    }
    double step = 0.5 * part;
    for (int i = 0; i < kSteps; ++i, step *= 0.5) {
        if (fits(part + step)) part += step;
    }
    return part;
}

/// Rounds a positive number down to two digits.
double rounded_down(double value) {
    const double exponent = std::floor(std::log10(value)) - 1.0;
    const double digits = std::floor(value / std::pow(10.0, exponent));
    // A quotient of whole numbers is the number that its two digits name: 69 / 100, not 69 * 0.01.
    return exponent < 0.0 ? digits / std::pow(10.0, -exponent) : digits * std::pow(10.0, exponent);
}

/// An error of `pack_charts` with the object and what helps.
Error with_object(Error error, const Scene& scene, uint32_t instance, uint32_t page_size,
                  double part) {
    const float scale = scene.instances[instance].lightmap.scale;
    std::string help = str_cat("; lower its extras.lightmap_scale from ", scale);
    if (part > 0.0) help += str_cat(" to ", rounded_down(part * double{scale}));
    help += " or the texels per metre";
    if (page_size < kMaxPageSize) help += str_cat(", or use pages larger than ", page_size);
    error.message = error.message.prefixed(name_of(scene, instance) + ": ").suffixed(help);
    return error;
}

Result<std::vector<LightmapPacking>> pack(const Scene& scene, const Work& work,
                                          const std::vector<Unwrapped>& unwraps,
                                          const LightmapLayoutSettings& settings) {
    const size_t count = work.packing_keys.size();
    std::vector<LightmapPacking> packings(count);
    std::vector<std::optional<Error>> errors(count);
    parallel_for(count, settings.thread_count, [&](size_t i) {
        const Unwrap& charts = unwraps[work.unwrap_of[i]].charts;
        auto packed =
            pack_charts(charts, {std::get<float>(work.packing_keys[i]), settings.page_size});
        if (!packed) {
            errors[i] = packed.error();
            return;
        }
        packings[i] = {std::get<0>(work.packing_keys[i]), std::move(*packed),
                       charts.triangle_charts};
    });
    for (size_t i = 0; i < count; ++i) {
        if (!errors[i]) continue;
        const double part = fitting_part(unwraps[work.unwrap_of[i]].charts,
                                         std::get<float>(work.packing_keys[i]), settings.page_size);
        return with_object(*errors[i], scene, work.first_instance[i], settings.page_size, part);
    }
    return packings;
}

Status place(LightmapLayout& layout, const std::vector<uint32_t>& packing_of) {
    std::vector<TexelSize> sizes;
    for (const uint32_t packing : packing_of) {
        TexelSize size;
        if (packing != kNoIndex) {
            const PackedCharts& charts = layout.packings[packing].charts;
            size = {charts.width, charts.height};
        }
        sizes.push_back(size);
    }
    const auto corners = pack_pages(sizes, layout.page_size);
    if (!corners) return corners.error();
    for (size_t i = 0; i < packing_of.size(); ++i) {
        const bool has_texels = sizes[i].width > 0 && sizes[i].height > 0;
        layout.places.push_back({has_texels ? packing_of[i] : kNoIndex, (*corners)[i]});
        if (has_texels) layout.page_count = std::max(layout.page_count, (*corners)[i].page + 1);
    }
    return Ok{};
}

}  // namespace

const char* name_of(LightmapUvs uvs) noexcept {
    constexpr const char* kNames[] = {"unwrap", "keep", "repair"};
    return kNames[static_cast<size_t>(uvs)];
}

bool takes_lightmap(const Scene& scene, const MeshInstance& instance) {
    const uint32_t material = scene.meshes[instance.mesh].material;
    const bool is_unlit = material != kNoIndex && scene.materials[material].is_unlit;
    return instance.contributes_gi && instance.lightmap.receive_gi == ReceiveGi::Lightmap &&
           instance.lightmap.scale > 0.0f && !is_unlit;
}

Result<LightmapLayout> make_lightmap_layout(const Scene& scene,
                                            const LightmapLayoutSettings& settings) {
    if (auto status = check(settings); !status) return status.error();
    const Work work = work_of(scene, settings.texels_per_meter);
    std::vector<Unwrapped> unwraps(work.unwrap_keys.size());
    parallel_for(unwraps.size(), settings.thread_count,
                 [&](size_t i) { unwraps[i] = unwrap_mesh(scene, work.unwrap_keys[i], settings); });
    LightmapLayout layout;
    layout.page_size = settings.page_size;
    layout.texels_per_meter = settings.texels_per_meter;
    for (size_t i = 0; i < work.packing_keys.size(); ++i) {
        const Unwrapped& unwrapped = unwraps[work.unwrap_of[i]];
        if (!unwrapped.is_bad()) continue;
        layout.warnings.push_back(
            uv_warning(scene, work.first_instance[i], unwrapped, settings.uvs));
    }
    auto packings = pack(scene, work, unwraps, settings);
    if (!packings) return packings.error();
    layout.packings = std::move(*packings);
    if (auto status = place(layout, work.packing_of); !status) return status.error();
    return layout;
}

}  // namespace tetralight
