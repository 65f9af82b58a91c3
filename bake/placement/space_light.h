// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// What reaches a part of space, directly or by reflections.
struct SpaceLight {
    bool has_sky = false;
    /// Lights of any mode and layer, and emission.
    bool has_lights = false;

    [[nodiscard]] bool is_dark() const { return !has_sky && !has_lights; }

    bool operator==(const SpaceLight&) const = default;
};

/// The light of each part, by paths from its positions (world space). Light that reaches hardly any
/// of them, such as what comes through cracks, does not count. Deterministic. Errors: those of
/// `bake_accumulators`.
[[nodiscard]] Result<std::vector<SpaceLight>> find_space_light(
    const Scene& scene, std::span<const std::vector<glm::dvec3>> parts, uint32_t thread_count = 0);

}  // namespace tetralight
