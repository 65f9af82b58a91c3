// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>

#include <tetralight/probes/no_index.h>
#include <tetralight/probes/probe_volume.h>

// Weights that know walls. Each directed edge i → j of a volume has an edge ratio r_ij: the length
// of the edge divided by the distance from probe i at which a surface blocks it, > 1 if one does.
// Corner i of a cell sees the position with barycentric weights b if
//
//     L_i = Σ_j b_j r_ij ≤ 1
//
// which is exact for planar walls, because planes are linear in barycentric coordinates. The ratios
// of edges that nothing blocks are fitted in [−4, 1], so that the plane L_i = 1 follows the wall.
// Where walls meet, edges from one corner may be blocked by different walls. Each wall then has a
// sum of its own, of its blocked edges and of all free ones, and L_i is the largest of them.
//
// Cells share the ratios of their common edges, and the walls of their common faces, so that
// weights are continuous. A cell whose ratios are all < 1 stores nothing: all of its corners see
// all of it.

namespace tetralight {

/// The code of ratio 1: of an edge about which nothing is known. Larger codes are blocked edges,
/// smaller ones are free.
inline constexpr int kUnknownEdge = 67;

/// The code of a free edge whose plane is not fitted.
inline constexpr uint8_t kFreeEdge = kUnknownEdge - 1;

/// Codes c stand for r = 1 + (c − 67) · |c − 67| / 896: from −4.01 to 40.45.
inline constexpr float kEdgeCodeUnit = 1.0f / 896.0f;

/// Hidden corners keep 0.01 / L² of their weights, so that weights are defined where no corner sees
/// the position. They share the sum of that by weight / L⁸: where walls meet, one plane a corner
/// hides even those that see the position, but these have the least L.
inline constexpr float kHiddenShare = 0.01f;

/// Weights fall from 1 to the share of hidden corners over L = 1 … 1.03.
inline constexpr float kVisibilityRamp = 0.03f;

/// r − 1 of a code. Every code > 67 gives a number > 0, every other one a number ≤ 0.
[[nodiscard]] inline float edge_excess(uint8_t code) noexcept {
    const int steps = int{code} - kUnknownEdge;
    return static_cast<float>(steps * std::abs(steps)) * kEdgeCodeUnit;
}

/// The edge ratio of a code.
[[nodiscard]] inline float decode_edge_ratio(uint8_t code) noexcept {
    return 1.0f + edge_excess(code);
}

/// The nearest code of a ratio. Ratios > 1 get a code > 67, ratios ≤ 1 one below: rounding neither
/// opens nor closes an edge. Precondition: not a NaN.
[[nodiscard]] inline uint8_t encode_edge_ratio(double ratio) noexcept {
    const double excess = ratio - 1.0;
    const double steps = std::round(std::sqrt(std::abs(excess) / double{kEdgeCodeUnit}));
    const double least = kUnknownEdge, most = 255 - kUnknownEdge;
    const double code =
        excess > 0.0 ? std::clamp(steps, 1.0, most) : -std::clamp(steps, 1.0, least);
    return static_cast<uint8_t>(kUnknownEdge + static_cast<int>(code));
}

/// The place in `CellVisibility::codes` of the edge from one corner to another.
[[nodiscard]] constexpr size_t edge_place(size_t from, size_t to) noexcept {
    return 4 * ((to - from - 1) & 3) + from;
}

/// The bit of `CellVisibility::splits`, read as a little-endian number, that says that different
/// walls block the edges from one corner to two others: for each corner three, of the edges at
/// places k = 0 and 1, 0 and 2, 1 and 2. Precondition: three corners.
[[nodiscard]] constexpr uint32_t split_bit(size_t from, size_t a, size_t b) noexcept {
    const size_t places = ((a - from - 1) & 3) + ((b - from - 1) & 3);
    return uint32_t{1} << (4 * (places - 1) + from);
}

/// The bits of a cell as a number.
[[nodiscard]] inline uint32_t split_bits(const CellVisibility& cell) noexcept {
    return uint32_t{cell.splits[0]} | uint32_t{cell.splits[1]} << 8;
}

/// Calls `use(from, a, b)` with corners a < b for each corner of a cell from which the edges to two
/// others are blocked: the pairs that can be split.
template <class Use>
void for_each_blocked_pair(const CellVisibility& cell, Use use) {
    const auto is_blocked = [&](size_t from, size_t to) {
        return from != to && cell.codes[edge_place(from, to)] > kUnknownEdge;
    };
    for (size_t from = 0; from < 4; ++from) {
        for (size_t a = 0; a < 4; ++a) {
            for (size_t b = a + 1; b < 4; ++b) {
                if (is_blocked(from, a) && is_blocked(from, b)) use(from, a, b);
            }
        }
    }
}

/// The index of a cell's element of `cell_visibility`. kNoIndex: it has none, its weights are as
/// they are. Any number of the volume may be corrupt.
[[nodiscard]] inline uint32_t find_visibility(const ProbeVolumeView& volume,
                                              uint32_t cell) noexcept {
    const size_t index = cell / 32;
    if (index >= volume.visibility_blocks.size()) return kNoIndex;
    const VisibilityBlock& block = volume.visibility_blocks[index];
    const uint32_t bit = uint32_t{1} << (cell % 32);
    if ((block.cells & bit) == 0) return kNoIndex;
    const auto before = static_cast<uint32_t>(std::popcount(block.cells & (bit - 1)));
    const uint32_t element = block.first + before;
    return element < volume.cell_visibility.size() ? element : kNoIndex;
}

/// The weights of a position in a cell, each multiplied by what its corner sees of the position,
/// with the sum that they had. Where all corners see the position they are the same to the bit.
/// Kernels repeat its order of operations. Precondition: weights are ≥ 0.
[[nodiscard]] glm::vec4 visible_weights(const CellVisibility& cell,
                                        const glm::vec4& weights) noexcept;

/// The same for an object of a size: the weight of a hidden corner falls over `radius` metres
/// behind the wall, measured along the line from the corner, if that is longer than the ramp.
/// `distances` are those from the position to the corners, metres. Precondition: radius ≥ 0.
[[nodiscard]] glm::vec4 visible_weights(const CellVisibility& cell, const glm::vec4& weights,
                                        const glm::vec4& distances, float radius) noexcept;

}  // namespace tetralight
