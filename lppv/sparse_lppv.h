// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <unordered_set>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>

// A grid of light for a world that is kilometres wide: points only where something is, in blocks of
// 8³ as OpenVDB stores them.
//
//     SparseBlocks blocks(spacing);
//     for (position : probes) blocks.add_box(position - reach, position + reach);
//     const auto lppv = make_sparse_lppv(volume, blocks, parallel_for);

namespace tetralight {

/// Grid points along a side of a block.
inline constexpr int kSparseBlockSide = 8;
inline constexpr size_t kSparseBlockPoints = 512;
/// As many points as the largest dense grid has.
inline constexpr size_t kMaxSparseBlocks = (size_t{1} << 24) / kSparseBlockPoints;

/// Blocks of an endless grid along the world's axes, whose point (i, j, k) is at (i, j, k) ·
/// spacing. Block (a, b, c) holds the points from (8a, 8b, 8c) to (8a + 7, 8b + 7, 8c + 7).
class SparseBlocks {
  public:
    /// Precondition: spacing > 0, metres.
    explicit SparseBlocks(double spacing);

    /// Adds the blocks of the cells that meet a box, so that every position in it lies between
    /// points. Errors say the number: more than kMaxSparseBlocks, and a box that is not finite or
    /// lies beyond 2²⁰ blocks from the origin.
    [[nodiscard]] Status add_box(const glm::dvec3& low, const glm::dvec3& high);

    [[nodiscard]] double spacing() const noexcept { return spacing_; }

    /// Sorted by z, then y, then x.
    [[nodiscard]] std::vector<glm::ivec3> sorted() const;

  private:
    double spacing_;
    std::unordered_set<uint64_t> keys_;
};

struct SparseLppv {
    double spacing = 1.0;
    std::vector<glm::ivec3> blocks;
    /// kSparseBlockPoints a block, x fastest, then y.
    std::vector<IrradianceSh> irradiance;
    /// As many, or none: (1, 1, 1, 1).
    std::vector<glm::vec4> occlusion;

    bool operator==(const SparseLppv&) const = default;
};

namespace detail {

/// Task i of `make_sparse_lppv` fills some blocks.
struct SparseFillTasks {
    const ProbeVolumeView& volume;
    SparseLppv& lppv;

    [[nodiscard]] size_t count() const noexcept;
    void run(size_t task) const;
};

/// With room for every point.
[[nodiscard]] SparseLppv empty_sparse_lppv(const ProbeVolumeView& volume,
                                           const SparseBlocks& blocks);

}  // namespace detail

/// Fills all points of the blocks, all nine coefficients, on the caller's threads (`interpolate`
/// says what `parallel_for` is). The same bytes for any number of threads.
template <class ParallelFor>
[[nodiscard]] SparseLppv make_sparse_lppv(const ProbeVolumeView& volume, const SparseBlocks& blocks,
                                          ParallelFor&& parallel_for) {
    SparseLppv lppv = detail::empty_sparse_lppv(volume, blocks);
    const detail::SparseFillTasks tasks{volume, lppv};
    parallel_for(tasks.count(), [&tasks](size_t task) { tasks.run(task); });
    return lppv;
}

}  // namespace tetralight
