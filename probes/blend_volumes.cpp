// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/blend_volumes.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

Status check_positions(const ProbeVolumeView& a, const ProbeVolumeView& b) {
    if (a.positions.size() != b.positions.size()) {
        return Error{ErrorCode::InvalidArgument, str_cat("the volumes have ", a.positions.size(),
                                                         " and ", b.positions.size(), " probes")};
    }
    for (size_t i = 0; i < a.positions.size(); ++i) {
        if (a.positions[i] == b.positions[i] && a.info.world_origin == b.info.world_origin) {
            continue;
        }
        return Error{ErrorCode::InvalidArgument,
                     str_cat("probe ", i, " is not at the same position in both volumes")};
    }
    if (!std::ranges::equal(a.cells, b.cells))
        return Error{ErrorCode::InvalidArgument, "the volumes have different cells"};
    if (a.irradiance.empty() != b.irradiance.empty()) {
        return Error{ErrorCode::InvalidArgument, "one of the volumes has light and the other none"};
    }
    return Ok{};
}

/// A light of the blend with its state and name.
struct ScaledLight {
    Light light;
    LightState state;
    std::string_view name;
};

/// Each light scaled by the weight of its layer and by `factor`.
std::vector<ScaledLight> lights_of(const ProbeVolumeView& volume, float factor) {
    const auto names = split_names(volume.light_names);
    std::vector<ScaledLight> lights;
    for (size_t i = 0; i < volume.lights.size(); ++i) {
        ScaledLight& one = lights.emplace_back();
        one.light = volume.lights[i];
        one.light.intensity *= light_weight(volume, i) * factor;
        if (i < volume.light_states.size()) one.state = volume.light_states[i];
        one.state.layer = kNoIndex;
        if (i < names.size()) one.name = names[i];
    }
    return lights;
}

bool is_same_but_for_intensity(const ScaledLight& a, const ScaledLight& b) {
    Light light = a.light;
    light.intensity = b.light.intensity;
    return light == b.light && a.name == b.name && a.state == b.state;
}

bool has_channel(const ScaledLight& scaled) {
    return scaled.state.channel != kNoIndex;
}

/// Merges the lights of `b` into those of `a`; returns the new index of each.
Result<std::vector<uint32_t>> add_lights(const std::vector<ScaledLight>& of_b,
                                         std::vector<ScaledLight>& lights) {
    const size_t count = lights.size();
    const bool has_channels = std::ranges::any_of(lights, has_channel);
    std::vector<bool> is_taken(count, false);
    std::vector<uint32_t> places;
    for (const ScaledLight& scaled : of_b) {
        size_t i = 0;
        while (i < count && (is_taken[i] || !is_same_but_for_intensity(lights[i], scaled))) ++i;
        places.push_back(static_cast<uint32_t>(i < count ? i : lights.size()));
        if (i < count) {
            lights[i].light.intensity += scaled.light.intensity;
            is_taken[i] = true;
        } else if (has_channel(scaled) && has_channels) {
            return Error{
                ErrorCode::InvalidArgument,
                str_cat("light \"", scaled.name,
                        "\" has occlusion, and the other volume has that of other lights, or in "
                        "another mixed-lighting mode")};
        } else {
            lights.push_back(scaled);
        }
    }
    return places;
}

void store_lights(const std::vector<ScaledLight>& lights, ProbeVolume& volume) {
    volume.lights.clear();
    volume.light_states.clear();
    volume.light_names.clear();
    for (const ScaledLight& scaled : lights) {
        volume.lights.push_back(scaled.light);
        volume.light_states.push_back(scaled.state);
        volume.light_names += std::string(scaled.name) + "\n";
    }
}

/// A copy without the members that blending fills or drops.
ProbeVolume without_light(const ProbeVolumeView& view) {
    ProbeVolumeView kept = view;
    kept.irradiance = {};
    kept.occlusion = {};
    kept.compact = {};
    kept.occlusion_lights = {};
    kept.layers = {};
    kept.layer_names = {};
    kept.layer_irradiance = {};
    kept.layer_errors = {};
    kept.transfer = {};
    kept.sky = {};
    kept.dering = {};
    return copy_volume(kept);
}

/// If only one scenario has occlusion, the channels are those of its lights. `places`: the new
/// indices of the lights of `b`.
void blend_occlusion(const ProbeVolumeView& a, const ProbeVolumeView& b, float t,
                     const std::vector<uint32_t>& places, ProbeVolume& volume) {
    const ProbeVolumeView& source = a.occlusion.empty() ? b : a;
    volume.occlusion.assign(source.occlusion.begin(), source.occlusion.end());
    volume.occlusion_lights.assign(source.occlusion_lights.begin(), source.occlusion_lights.end());
    if (a.occlusion.empty()) {
        for (OcclusionLights& lights : volume.occlusion_lights) {
            for (uint32_t& light : lights) light = light < places.size() ? places[light] : kNoIndex;
        }
    }
    if (a.occlusion.empty() || b.occlusion.empty()) return;
    for (size_t i = 0; i < volume.occlusion.size(); ++i) {
        volume.occlusion[i] = (1.0f - t) * a.occlusion[i] + t * b.occlusion[i];
    }
}

}  // namespace

Result<ProbeVolume> blend_volumes(const ProbeVolumeView& a, const ProbeVolumeView& b, float t) {
    if (!(t >= 0.0f && t <= 1.0f))
        return Error{ErrorCode::InvalidArgument, "t", str_cat(t),
                     str_cat("a blend of ", t, " is not in [0, 1]")};
    if (auto status = check_positions(a, b); !status) return status.error();
    std::vector<ScaledLight> lights = lights_of(a, 1.0f - t);
    const auto places = add_lights(lights_of(b, t), lights);
    if (!places) return places.error();
    ProbeVolume volume = without_light(a);
    volume.info.ambient = (1.0f - t) * a.info.ambient + t * b.info.ambient;
    for (size_t i = 0; i < a.irradiance.size(); ++i) {
        volume.irradiance.push_back((1.0f - t) * a.irradiance[i] + t * b.irradiance[i]);
    }
    store_lights(lights, volume);
    blend_occlusion(a, b, t, *places, volume);
    if (!a.compact.empty()) make_compact_probes(volume);
    return volume;
}

}  // namespace tetralight
