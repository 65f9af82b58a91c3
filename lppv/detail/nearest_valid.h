// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/no_index.h>

namespace tetralight::detail {

/// The index of the nearest valid point for each grid point: its own if it is valid, kNoIndex if no
/// point is valid. Exact for orthogonal axes with `spacing` metres between points (0 counts as 1).
/// One pass over the lines of each axis: Felzenszwalb & Huttenlocher 2012, "Distance Transforms of
/// Sampled Functions", algorithm 1. Precondition: one validity per point.
[[nodiscard]] std::vector<uint32_t> nearest_valid(glm::uvec3 resolution, glm::dvec3 spacing,
                                                  std::span<const float> validity,
                                                  float min_validity);

/// Gives each invalid point the light and occlusion of its nearest valid point; occlusion may be
/// empty. Returns the number of replaced points.
template <class Light>
size_t replace_invalid(std::span<const uint32_t> nearest_valid, std::span<Light> light,
                       std::span<glm::vec4> occlusion) noexcept {
    size_t count = 0;
    for (size_t i = 0; i < nearest_valid.size(); ++i) {
        const uint32_t nearest = nearest_valid[i];
        if (nearest == i || nearest == kNoIndex) continue;
        light[i] = light[nearest];
        if (!occlusion.empty()) occlusion[i] = occlusion[nearest];
        ++count;
    }
    return count;
}

}  // namespace tetralight::detail
