// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/no_index.h>

namespace tetralight {

/// Range of the edge ratios of free edges (probes/edge_visibility.h).
inline constexpr double kLeastFreeRatio = -4.0;
inline constexpr double kMostFreeRatio = 1.0;

/// What a ray from a probe to a position on the face opposite to it says of the edge ratios of that
/// probe: L = known + Σ weights[k] · ratio(edges[k]) is `ratio`, or at most 1 if nothing blocks it.
struct RatioSample {
    /// Free edges, by an index of the caller's; kNoIndex for none.
    std::array<uint32_t, 3> edges{kNoIndex, kNoIndex, kNoIndex};
    /// Barycentric weights of the ends of these edges.
    std::array<double, 3> weights{};
    /// The part of the edges that are blocked: Σ weight · ratio.
    double known = 0.0;
    /// 1 / the fraction of the way at which the ray is blocked. 0: it is not.
    double ratio = 0.0;
};

/// The ratios of the free edges 0 … edge_count − 1 of one probe that fit the samples best in the
/// sense of least squares, in [−4, 1]. For a planar wall that reaches through all sampled cells
/// L = 1 is that plane. Pure.
[[nodiscard]] std::vector<double> fit_edge_ratios(size_t edge_count,
                                                  std::span<const RatioSample> samples);

}  // namespace tetralight
