// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <tetralight/probes/detail/query_block.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/query_output.h>
#include <tetralight/probes/receiver.h>
#include <tetralight/probes/seed_grid.h>

// The inner loops of a batch. Each exists as plain C++ (the scalar twin) and, where Highway is
// found, as vector code that is chosen for the processor at run time. Both do the same arithmetic
// in the same order and give the same bits.

namespace tetralight::detail {

/// What vector code finds of some queries of a `CellList`, side by side.
struct CellLanes {
    static constexpr size_t kCount = 16;

    template <class T>
    using Lanes = std::array<T, kCount>;

    /// In a tetrahedron the four signed volumes (`signed_volumes`) and the largest coordinate of
    /// the corners, relative to the query. In a hull cell three weights (`hull_cell_weights`).
    alignas(64) std::array<Lanes<double>, 4> values;
    alignas(64) Lanes<double> farthest;
    /// False if only scalar code can find the values.
    Lanes<bool> is_known;
};

/// Output of blended probes: location i is answer `answers[i]`.
struct BlendTarget {
    std::span<const uint32_t> answers;
    const ShOutput& irradiance;
    const OcclusionOutput& occlusion;
    Walls walls = Walls::HideProbes;
};

struct QueryKernels {
    /// Finds `course` of each query as `find_place`; writes its local position to the same place of
    /// `block.tetrahedra`, and to `start` the place of its word in the outermost seed grid
    /// (`seed_word`), or kNoIndex if it is far away or not finite.
    void (*place_queries)(const SeedGridHeader& grid, const VolumeInfo& info, QueryBlock& block);
    /// Then, with the cells where walks begin in `start`: fills the lists.
    void (*begin_walks)(const VolumeInfo& info, QueryBlock& block);
    /// Tests the tetrahedron of each query of `block.tetrahedra` in single precision. The volume
    /// has tetrahedra (`has_tetrahedra`).
    void (*test_tetrahedra)(const ProbeVolumeView& volume, QueryBlock& block);
    /// Values of the queries from `begin` on, in tetrahedra or hull cells. Lists have room for
    /// `CellLanes::kCount` queries behind `begin`; what is behind their end has no meaning.
    void (*measure_tetrahedra)(const ProbeVolumeView& volume, const QueryBlock& block,
                               const CellList& list, size_t begin, CellLanes& lanes);
    void (*measure_hull_cells)(const ProbeVolumeView& volume, const QueryBlock& block,
                               const CellList& list, size_t begin, CellLanes& lanes);
    /// Blends and writes.
    void (*blend)(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                  const BlendTarget& target);
};

[[nodiscard]] const QueryKernels& scalar_kernels() noexcept;

/// The fastest kernels that this machine supports.
[[nodiscard]] const QueryKernels& query_kernels() noexcept;

}  // namespace tetralight::detail
