// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/runtime_lights.h>

#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

float brightness(const Light& light) {
    return light.intensity.x + light.intensity.y + light.intensity.z;
}

const LightState& state_of(const ProbeVolumeView& volume, size_t light) {
    static constexpr LightState kPlain;
    return light < volume.light_states.size() ? volume.light_states[light] : kPlain;
}

/// The brightest mixed sun, or kNoIndex.
uint32_t main_sun(const ProbeVolumeView& volume) {
    uint32_t sun = kNoIndex;
    for (uint32_t i = 0; i < volume.lights.size(); ++i) {
        const Light& light = volume.lights[i];
        if (light.type != LightType::Directional || light.mode != LightMode::Mixed) continue;
        if (sun == kNoIndex || brightness(light) > brightness(volume.lights[sun])) sun = i;
    }
    return sun;
}

}  // namespace

std::vector<RuntimeLight> runtime_lights(const ProbeVolumeView& volume) {
    std::vector<RuntimeLight> lights;
    const uint32_t sun = main_sun(volume);
    for (uint32_t i = 0; i < volume.lights.size(); ++i) {
        if (volume.lights[i].mode == LightMode::Baked) continue;
        const LightState& state = state_of(volume, i);
        const bool is_mixed = volume.lights[i].mode == LightMode::Mixed;
        const bool is_still =
            is_mixed && state.mixed_lighting == MixedLighting::Subtractive && i != sun;
        RuntimeLight& light = lights.emplace_back(
            RuntimeLight{volume.lights[i], i, is_mixed ? state.channel : kNoIndex, !is_still});
        light.light.intensity *= light_weight(volume, i);
    }
    return lights;
}

float interpolate_visibility(const ProbeVolumeView& volume, const CellLocation& location,
                             const RuntimeLight& light) noexcept {
    const size_t count = volume.positions.size();
    if (light.channel >= 4 || location.cell >= volume.cells.size()) return 1.0f;
    if (volume.occlusion.size() != count || volume.occlusion_lights.size() != count) return 1.0f;
    const Cell& cell = volume.cells[location.cell];
    float sum = 0.0f, total = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
        if (probe >= count) continue;
        if (volume.occlusion_lights[probe][light.channel] != light.index) continue;
        sum += location.weights[i] * volume.occlusion[probe][static_cast<int>(light.channel)];
        total += location.weights[i];
    }
    if (!(total > 0.0f)) return 1.0f;
    return location.ambient + (1.0f - location.ambient) * (sum / total);
}

}  // namespace tetralight
