// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/detail/tetrahedron_test.h>

namespace tetralight::detail {

/// What follows from the weights of a query in a hull cell.
[[nodiscard]] inline CellTest judge_hull_weights(const ProbeVolumeView& volume, uint32_t cell,
                                                 const glm::dvec3& weights) noexcept {
    int face = weights.x <= weights.y ? 0 : 1;
    if (weights.z < weights[face]) face = 2;
    const double least = weights[face];
    if (least >= 0.0) {
        return {Verdict::Inside, kNoIndex, {cell, 0.0f, glm::vec4(glm::dvec4(weights + 0.0, 0.0))}};
    }
    return least < -kHullRounding ? leave_cell(volume, cell, static_cast<size_t>(face))
                                  : CellTest{};
}

/// One step of a walk in a hull cell, in double. A query without weights is behind the hull
/// triangle. Precondition: `cell` is in range.
[[nodiscard]] CellTest test_hull_cell(const ProbeVolumeView& volume, uint32_t cell,
                                      const glm::dvec3& local) noexcept;

}  // namespace tetralight::detail
