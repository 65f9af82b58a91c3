// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/probes/distant_light.h>
#include <tetralight/probes/no_index.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// How a bake splits the light of a scene. By default it does not.
struct LightPlan {
    /// One a light: what is baked of it; empty: what the scene says.
    std::vector<LightMode> light_modes;
    /// The layer of each light, each material's emission, and the sky. kNoIndex, or an empty
    /// vector: none of the first `layer_count`, but what is left of the whole.
    std::vector<uint32_t> layer_of_light;
    std::vector<uint32_t> layer_of_material;
    uint32_t layer_of_sky = kNoIndex;
    uint32_t layer_count = 0;
    /// Also finds how probes answer to distant light (probes/transfer.h).
    bool has_transfer = false;
    /// Also finds the visibility of lights (bake/occlusion.h).
    bool has_occlusion = false;

    [[nodiscard]] LightMode mode_of(const Scene& scene, size_t light) const {
        return light_modes.empty() ? scene.lights[light].mode : light_modes[light];
    }

    [[nodiscard]] uint32_t layer_of(const std::vector<uint32_t>& layers, size_t source) const {
        return source < layers.size() ? layers[source] : kNoIndex;
    }

    /// Whether light is split at all.
    [[nodiscard]] bool has_light_groups() const { return layer_count > 0 || has_transfer; }

    bool operator==(const LightPlan&) const = default;
};

/// What a probe's light is split into, as one row of numbers: radiance of each layer, transfer of
/// radiance (what arrives straight away, then what was reflected), occlusion.
struct LightGroupLayout {
    static constexpr size_t kLayerSize = 3 * size_t{kShCoefficientCount};
    static constexpr size_t kDirectSize = size_t{kShCoefficientCount} * kDistantCoefficientCount;
    static constexpr size_t kBouncedSize = 3 * kDirectSize;

    LightGroupLayout() = default;

    explicit LightGroupLayout(const LightPlan& plan)
        : layer_count(plan.layer_count),
          has_transfer(plan.has_transfer),
          has_occlusion(plan.has_occlusion) {}

    uint32_t layer_count = 0;
    bool has_transfer = false;
    bool has_occlusion = false;

    [[nodiscard]] size_t direct_begin() const { return layer_count * kLayerSize; }

    [[nodiscard]] size_t bounced_begin() const { return direct_begin() + kDirectSize; }

    [[nodiscard]] size_t occlusion_begin() const {
        return direct_begin() + (has_transfer ? kDirectSize + kBouncedSize : 0);
    }

    /// Numbers of a row.
    [[nodiscard]] size_t size() const { return occlusion_begin() + (has_occlusion ? 4 : 0); }

    bool operator==(const LightGroupLayout&) const = default;
};

}  // namespace tetralight
