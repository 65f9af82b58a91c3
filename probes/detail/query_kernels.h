// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/query_output.h>

// The inner loops of a batch: testing tetrahedra, weights in hull cells, and blending probes. Each
// exists as plain C++ (the scalar twin) and, where Highway is found, as vector code that is chosen
// for the processor at run time. Both do the same arithmetic in the same order and give the same
// bits.

namespace tetralight::detail {

/// Lanes of the widest vectors of doubles: lists have room for one vector behind their end.
inline constexpr size_t kMostLanes = 8;

/// Queries that wait for the test of a cell, side by side.
template <size_t kCapacity>
struct QueryList {
    template <class T>
    using Lanes = std::array<T, kCapacity + kMostLanes>;

    /// Local positions.
    alignas(64) Lanes<double> x;
    alignas(64) Lanes<double> y;
    alignas(64) Lanes<double> z;
    alignas(64) Lanes<uint32_t> query;  ///< in the block
    alignas(64) Lanes<uint32_t> cell;
    size_t count = 0;

    void add(const glm::dvec3& local, uint32_t query_index, uint32_t cell_index) {
        x[count] = local.x;
        y[count] = local.y;
        z[count] = local.z;
        query[count] = query_index;
        cell[count++] = cell_index;
    }

    void move(size_t from, size_t to) {
        x[to] = x[from];
        y[to] = y[from];
        z[to] = z[from];
        query[to] = query[from];
        cell[to] = cell[from];
    }
};

/// Queries that are processed together, in passes: each pass tests one cell for every query that
/// is not located yet.
struct QueryBlock {
    static constexpr size_t kSize = 256;

    /// In and out: queries whose next cell is a tetrahedron, below `inner_cell_count`.
    QueryList<kSize> tetrahedra;
    /// Those whose next cell is a hull cell.
    QueryList<kSize> hull_cells;
    /// Out: queries for the general code (`Walk`), and the cell that they reached.
    std::array<uint32_t, kSize + kMostLanes> doubtful;
    std::array<uint32_t, kSize + kMostLanes> doubtful_cell;
    size_t doubtful_count = 0;
    /// Out: where queries are. Vectors write behind the end.
    std::array<CellLocation, kSize + kMostLanes> location;
};

/// Hull cells relative to one query each, side by side: `HullTriangle` and rays.
struct HullLanes {
    static constexpr size_t kCount = 8;

    template <class T>
    using Lanes = std::array<T, kCount>;
    using Vectors = std::array<Lanes<double>, 3>;

    alignas(64) Vectors first{};
    alignas(64) Vectors second{};
    alignas(64) Vectors to_query{};
    /// Ray i, coordinate k: [i][k].
    alignas(64) std::array<Vectors, 3> rays{};
    /// Out: as `hull_cell_weights`.
    alignas(64) Vectors weights{};
    /// Out: false if the cell gives no weights, or only `hull_cell_weights` can find them.
    Lanes<bool> is_known{};
};

/// Output of blended probes: location i is answer `answers[i]`.
struct BlendTarget {
    std::span<const uint32_t> answers;
    const ShOutput& irradiance;
    const OcclusionOutput& occlusion;
};

/// Tests the tetrahedron of the query at place `from` of `block.tetrahedra`; if it goes on in a
/// tetrahedron it moves to place `kept`. Returns the number of those that have been kept.
[[nodiscard]] size_t test_query(const ProbeVolumeView& volume, QueryBlock& block, size_t from,
                                size_t kept) noexcept;

struct QueryKernels {
    /// Tests the tetrahedron of each query of `block.tetrahedra`, as `test_tetrahedron`. The
    /// volume has tetrahedra (`has_tetrahedra`).
    void (*test_tetrahedra)(const ProbeVolumeView& volume, QueryBlock& block);
    /// Weights of each lane's query in its hull cell.
    void (*hull_weights)(HullLanes& lanes);
    /// Blends and writes.
    void (*blend)(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                  const BlendTarget& target);
};

[[nodiscard]] const QueryKernels& scalar_kernels() noexcept;

/// The fastest kernels that this machine supports.
[[nodiscard]] const QueryKernels& query_kernels() noexcept;

}  // namespace tetralight::detail
