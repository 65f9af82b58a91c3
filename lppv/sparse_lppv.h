// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <unordered_set>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>

// A grid of light for a world of many kilometres: points only near geometry and probes, in blocks
// of 8³ points, the leaves of OpenVDB.
//
//     SparseBlocks blocks(spacing);
//     for (position : probes) blocks.add_box(position - reach, position + reach);
//     const auto lppv = make_sparse_lppv(volume, blocks, parallel_for);

namespace tetralight {

/// Grid points along a side of a block.
inline constexpr int kSparseBlockSide = 8;
inline constexpr size_t kSparseBlockPoints = 512;
/// The number of points equals that of the largest dense grid.
inline constexpr size_t kMaxSparseBlocks = (size_t{1} << 24) / kSparseBlockPoints;

/// Blocks of an infinite grid along the world's axes with point (i, j, k) at (i, j, k) · spacing.
/// Block (a, b, c) contains the points from (8a, 8b, 8c) to (8a + 7, 8b + 7, 8c + 7).
class SparseBlocks {
  public:
    /// Precondition: spacing > 0, metres.
    explicit SparseBlocks(double spacing);

    /// Adds the blocks of all grid cells that overlap a box, so that every position in it lies
    /// between points. Returns invalid_argument if there are more than kMaxSparseBlocks, or if the
    /// box is not finite or extends further than 2²⁰ blocks from the origin.
    [[nodiscard]] Status add_box(const glm::dvec3& min, const glm::dvec3& max);

    [[nodiscard]] double spacing() const noexcept { return spacing_; }

    /// Sorted by z, then y, then x.
    [[nodiscard]] std::vector<glm::ivec3> sorted() const;

  private:
    double spacing_;
    std::unordered_set<uint64_t> keys_;
};

/// The light of a sparse grid.
struct SparseLppv {
    double spacing = 1.0;
    std::vector<glm::ivec3> blocks;
    /// kSparseBlockPoints per block, x fastest, then y.
    std::vector<IrradianceSh> irradiance;
    /// Four channels per point, 1 = lit. Empty: all are (1, 1, 1, 1).
    std::vector<glm::vec4> occlusion;

    bool operator==(const SparseLppv&) const = default;
};

namespace detail {

/// The parallel part of `make_sparse_lppv`: each task fills some blocks.
struct SparseFillTasks {
    const ProbeVolumeView& volume;
    SparseLppv& lppv;
    Receiver receiver;

    [[nodiscard]] size_t count() const noexcept;
    void run(size_t task) const;
};

/// Allocated for all points, without light.
[[nodiscard]] SparseLppv empty_sparse_lppv(const ProbeVolumeView& volume,
                                           const SparseBlocks& blocks);

}  // namespace detail

/// Fills all nine coefficients at all points of the blocks on the caller's threads (`interpolate`
/// describes `parallel_for`). Gives the same bytes for any number of threads. `receiver` is that of
/// `LppvFill`.
template <class ParallelFor>
[[nodiscard]] SparseLppv make_sparse_lppv(const ProbeVolumeView& volume, const SparseBlocks& blocks,
                                          ParallelFor&& parallel_for,
                                          const Receiver& receiver = {}) {
    SparseLppv lppv = detail::empty_sparse_lppv(volume, blocks);
    const detail::SparseFillTasks tasks{volume, lppv, receiver};
    parallel_for(tasks.count(), [&tasks](size_t task) { tasks.run(task); });
    return lppv;
}

}  // namespace tetralight
