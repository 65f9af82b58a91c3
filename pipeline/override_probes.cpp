// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/override_probes.h>

#include <algorithm>

#include <tetralight/probes/rendering_layers.h>

namespace tetralight {

std::vector<ProbeOverride> find_overrides(std::span<const ProbeAdjustment> adjustments,
                                          std::span<const glm::dvec3> positions) {
    std::vector<ProbeOverride> overrides;
    if (adjustments.empty()) return overrides;
    for (const glm::dvec3& position : positions) {
        const AdjustmentAt at = adjustment_at(adjustments, position);
        overrides.push_back({at.intensity, at.validity.value_or(-1.0f)});
    }
    const auto is_default = [](const ProbeOverride& o) { return o == ProbeOverride{}; };
    if (std::ranges::all_of(overrides, is_default)) overrides.clear();
    return overrides;
}

void override_rendering_layers(std::span<const ProbeAdjustment> adjustments, ProbeVolume& volume) {
    if (adjustments.empty()) return;
    for (size_t i = 0; i < volume.exact_positions.size(); ++i) {
        const auto layers = adjustment_at(adjustments, volume.exact_positions[i]).rendering_layers;
        if (!layers) continue;
        if (volume.rendering_layers.empty()) {
            volume.rendering_layers.assign(volume.exact_positions.size(), kAllRenderingLayers);
        }
        volume.rendering_layers[i] = *layers;
    }
}

namespace {

void scale(ProbeTransfer& transfer, float factor) {
    for (auto& row : transfer.direct) {
        for (float& entry : row) entry *= factor;
    }
    for (auto& row : transfer.bounced) {
        for (glm::vec3& entry : row) entry *= factor;
    }
}

/// Scales the irradiance, the layers and the transfer of one probe.
void scale_light(size_t probe, float factor, ProbeVolume& volume) {
    const size_t probe_count = volume.positions.size();
    volume.irradiance[probe] *= factor;
    for (size_t i = probe; i < volume.layer_irradiance.size(); i += probe_count) {
        volume.layer_irradiance[i] *= factor;
    }
    if (!volume.transfer.empty()) scale(volume.transfer[probe], factor);
}

}  // namespace

void override_probes(std::span<const ProbeOverride> overrides, ProbeVolume& volume) {
    for (size_t i = 0; i < overrides.size(); ++i) {
        if (overrides[i].intensity != 1.0f) scale_light(i, overrides[i].intensity, volume);
        if (overrides[i].validity >= 0.0f) volume.validity[i] = overrides[i].validity;
    }
}

}  // namespace tetralight
