// SPDX-License-Identifier: Apache-2.0
// What a volume holds: its arrays, its details and the lights of its scene.
#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <iterator>
#include <string_view>

#include <tetralight/probes/recombine.h>
#include <tetralight/probes/relight.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_relight.h>
#include <tetralight/runtime/detail/c_views.h>
#include <tetralight/runtime/detail/c_volume.h>
#include <tetralight/runtime/tetralight.h>

namespace {

using namespace tetralight;
using detail::c_view;
using detail::check_pointer;
using detail::finish;
using detail::succeed;
using detail::view_of;

static_assert(TETRALIGHT_LIGHT_DISC == static_cast<uint32_t>(LightType::Disc));
static_assert(TETRALIGHT_LIGHT_REALTIME == static_cast<uint32_t>(LightMode::Realtime));
static_assert(TETRALIGHT_FALLOFF_LEGACY == static_cast<uint32_t>(LightFalloff::Legacy));

/// An array of a volume by its name.
struct NamedArray {
    const char* name;
    tetralight_const_array (*view)(const ProbeVolumeView& volume);
};

/// In the order of tetralight_volume_array.
constexpr NamedArray kArrays[] = {
    {"positions", [](const ProbeVolumeView& v) { return c_view(v.positions); }},
    {"exact positions", [](const ProbeVolumeView& v) { return c_view(v.exact_positions); }},
    {"irradiance as floats", [](const ProbeVolumeView& v) { return c_view(v.irradiance); }},
    {"light as halves", [](const ProbeVolumeView& v) { return c_view(v.compact); }},
    {"occlusion as floats", [](const ProbeVolumeView& v) { return c_view(v.occlusion); }},
    {"validity as floats", [](const ProbeVolumeView& v) { return c_view(v.validity); }},
    {"standard errors",
     [](const ProbeVolumeView& v) { return c_view(v.health, &ProbeHealth::standard_error); }},
    {"surface distances",
     [](const ProbeVolumeView& v) { return c_view(v.health, &ProbeHealth::surface_distance); }},
    {"virtual offsets",
     [](const ProbeVolumeView& v) { return c_view(v.health, &ProbeHealth::virtual_offset); }},
    {"dilated probes",
     [](const ProbeVolumeView& v) { return c_view(v.health, &ProbeHealth::is_dilated); }},
    {"rendering layers", [](const ProbeVolumeView& v) { return c_view(v.rendering_layers); }},
    {"cells", [](const ProbeVolumeView& v) { return c_view(v.cells, &Cell::vertices); }},
    {"cells", [](const ProbeVolumeView& v) { return c_view(v.cells, &Cell::neighbors); }},
    {"hull rays", [](const ProbeVolumeView& v) { return c_view(v.hull_rays); }},
    {"sources", [](const ProbeVolumeView& v) { return c_view(v.sources); }},
    {"irradiance of layers", [](const ProbeVolumeView& v) { return c_view(v.layer_irradiance); }},
    {"standard errors of layers", [](const ProbeVolumeView& v) { return c_view(v.layer_errors); }},
    {"sky", [](const ProbeVolumeView& v) { return c_view(v.sky); }},
    {"group names", [](const ProbeVolumeView& v) { return c_view(v.group_names); }},
    {"light names", [](const ProbeVolumeView& v) { return c_view(v.light_names); }},
    {"layer names", [](const ProbeVolumeView& v) { return c_view(v.layer_names); }},
    {"metadata", [](const ProbeVolumeView& v) { return c_view(v.metadata); }},
};

static_assert(std::size(kArrays) == TETRALIGHT_ARRAY_METADATA + 1);

void write_box(const ProbeVolumeView& view, tetralight_details& details) {
    if (view.positions.empty()) return;
    glm::vec3 low = view.positions[0], high = low;
    for (const glm::vec3& position : view.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    for (int i = 0; i < 3; ++i) {
        details.low[i] = details.world_origin[i] + low[i];
        details.high[i] = details.world_origin[i] + high[i];
    }
}

void write_vector(const glm::vec3& from, float (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

void write_name(std::string_view names, uint32_t index, char (&to)[128]) {
    const auto lines = split_names(names);
    const std::string_view name = index < lines.size() ? lines[index] : std::string_view();
    const size_t length = std::min(name.size(), sizeof to - 1);
    if (length > 0) std::memcpy(to, name.data(), length);
    to[length] = '\0';
}

tetralight_scene_light scene_light(const ProbeVolumeView& view, uint32_t index) {
    const Light& from = view.lights[index];
    tetralight_scene_light light{};
    write_name(view.light_names, index, light.name);
    light.type = static_cast<uint32_t>(from.type);
    light.mode = static_cast<uint32_t>(from.mode);
    light.falloff = static_cast<uint32_t>(from.falloff);
    light.channel = index < view.light_states.size() ? view.light_states[index].channel : kNoIndex;
    light.weight = light_weight(view, index);
    write_vector(from.intensity, light.intensity);
    write_vector(from.position, light.position);
    write_vector(from.direction, light.direction);
    light.range = from.range;
    light.cos_inner_cone = from.cos_inner_cone;
    light.cos_outer_cone = from.cos_outer_cone;
    light.radius = from.radius;
    write_vector(from.tangent, light.tangent);
    light.width = from.width;
    light.height = from.height;
    return light;
}

}  // namespace

tetralight_status tetralight_get_array(const tetralight_volume* volume, uint32_t which,
                                       tetralight_const_array* array,
                                       tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("array", array)) return finish(wrong, error);
    if (which >= std::size(kArrays)) {
        return finish({TETRALIGHT_BAD_VALUE, str_cat("which is out of range: ", which)}, error);
    }
    const tetralight_const_array view = kArrays[which].view(view_of(*volume));
    if (!view.data) {
        return finish(
            {TETRALIGHT_NOT_THERE, str_cat("the volume does not hold ", kArrays[which].name)},
            error);
    }
    *array = view;
    return succeed(error);
}

tetralight_status tetralight_get_details(const tetralight_volume* volume,
                                         tetralight_details* details,
                                         tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("details", details)) return finish(wrong, error);
    const ProbeVolumeView& view = view_of(*volume);
    tetralight_details made{};
    for (int i = 0; i < 3; ++i) made.world_origin[i] = view.info.world_origin[i];
    write_box(view, made);
    std::memcpy(made.ambient, &view.info.ambient, sizeof made.ambient);
    made.half_scale = view.compact.empty() ? 0.0f : view.info.compact_scale;
    made.knows_walls = view.visibility_blocks.empty() ? 0u : 1u;
    made.can_relight_sky = detail::check_relight(view, detail::DistantLayer::Sky) ? 0u : 1u;
    made.can_relight_sun = detail::check_relight(view, detail::DistantLayer::Sun) ? 0u : 1u;
    made.light_count = static_cast<uint32_t>(view.lights.size());
    *details = made;
    return succeed(error);
}

tetralight_status tetralight_get_scene_light(const tetralight_volume* volume, uint32_t index,
                                             tetralight_scene_light* light,
                                             tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("light", light)) return finish(wrong, error);
    const ProbeVolumeView& view = view_of(*volume);
    if (index >= view.lights.size()) {
        return finish({TETRALIGHT_NOT_THERE,
                       str_cat("there is no light ", index, " of ", view.lights.size())},
                      error);
    }
    *light = scene_light(view, index);
    return succeed(error);
}
