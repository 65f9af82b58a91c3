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

/// Which lights a bake includes, and which light groups (light of one layer, transfer of distant
/// light) it keeps apart in addition to the sum. By default it keeps none.
struct LightPlan {
    /// The mode of each light; empty = the modes of the scene.
    std::vector<LightMode> light_modes;
    /// The layer of each light, of each material's emission, and of the sky. kNoIndex or an empty
    /// vector: part of the sum only, of none of the `layer_count` layers.
    std::vector<uint32_t> layer_of_light;
    std::vector<uint32_t> layer_of_material;
    uint32_t layer_of_sky = kNoIndex;
    uint32_t layer_count = 0;
    /// Some light is in none of the layers: the total minus all layers is a layer of its own, with
    /// error bars.
    bool has_rest = false;
    /// Bake the transfer of distant light (probes/transfer.h).
    bool has_transfer = false;
    /// Bake the visibility of lights (bake/occlusion.h).
    bool has_occlusion = false;
    /// Of texels: bake how open their surroundings are up to this distance, metres
    /// (bake/ambient_occlusion.h). 0: no.
    float ambient_occlusion_distance = 0.0f;

    [[nodiscard]] LightMode mode_of(const Scene& scene, size_t light) const {
        return light_modes.empty() ? scene.lights[light].mode : light_modes[light];
    }

    [[nodiscard]] uint32_t layer_of(const std::vector<uint32_t>& layers, size_t source) const {
        return source < layers.size() ? layers[source] : kNoIndex;
    }

    /// True if paths have to record their light by source.
    [[nodiscard]] bool has_light_groups() const { return layer_count > 0 || has_transfer; }

    bool operator==(const LightPlan&) const = default;
};

/// Layout of the light groups of one probe as a row of values: the radiance of each layer (9 RGB
/// coefficients), the direct transfer, the bounced transfer (RGB), the four occlusion channels, the
/// ambient occlusion, and the variance of each layer, the last that of the rest if there is one.
struct LightGroupLayout {
    static constexpr size_t kLayerSize = 3 * size_t{kShCoefficientCount};
    static constexpr size_t kDirectSize = size_t{kShCoefficientCount} * kDistantCoefficientCount;
    static constexpr size_t kBouncedSize = 3 * kDirectSize;

    LightGroupLayout() = default;

    explicit LightGroupLayout(const LightPlan& plan)
        : layer_count(plan.layer_count),
          has_rest(plan.has_rest),
          has_transfer(plan.has_transfer),
          has_occlusion(plan.has_occlusion),
          has_ambient_occlusion(plan.ambient_occlusion_distance > 0.0f) {}

    uint32_t layer_count = 0;
    bool has_rest = false;
    bool has_transfer = false;
    bool has_occlusion = false;
    bool has_ambient_occlusion = false;

    [[nodiscard]] size_t direct_begin() const { return layer_count * kLayerSize; }

    [[nodiscard]] size_t bounced_begin() const { return direct_begin() + kDirectSize; }

    [[nodiscard]] size_t occlusion_begin() const {
        return direct_begin() + (has_transfer ? kDirectSize + kBouncedSize : 0);
    }

    [[nodiscard]] size_t ambient_occlusion_begin() const {
        return occlusion_begin() + (has_occlusion ? 4 : 0);
    }

    [[nodiscard]] size_t variance_begin() const {
        return ambient_occlusion_begin() + (has_ambient_occlusion ? 1 : 0);
    }

    /// True if a place has values that are found once, not summed over its samples.
    [[nodiscard]] bool has_single_values() const { return has_occlusion || has_ambient_occlusion; }

    /// Layers that have a variance: all, and the rest.
    [[nodiscard]] uint32_t variance_count() const { return layer_count + (has_rest ? 1 : 0); }

    /// Values per row.
    [[nodiscard]] size_t size() const { return variance_begin() + variance_count(); }

    bool operator==(const LightGroupLayout&) const = default;
};

}  // namespace tetralight
