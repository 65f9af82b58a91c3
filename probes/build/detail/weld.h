// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight::detail {

struct Weld {
    /// For each position the one that stands for its cluster: the lexicographically smallest.
    std::vector<uint32_t> representatives;
    /// No two representatives are nearer to each other than this, metres.
    double radius = 0.0;
};

/// Joins positions that are nearer to each other than both of their radii, transitively. The radius
/// of a position is `tolerance` times the local spacing, and at least a few steps of the floats
/// that hold it relative to the local origin. The local spacing is the distance to the seventh
/// nearest neighbor (with fewer than eight positions the median one), 10 m at most.
/// Precondition: distinct, in Hilbert order. Cost: O(n log n), for clouds of near duplicates too.
[[nodiscard]] Weld weld(std::span<const glm::dvec3> positions, double tolerance);

}  // namespace tetralight::detail
