// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/query_output.h>

// The inner loops of a batch: walking through tetrahedra, weights in hull cells, and blending
// probes. Each exists as plain C++ (the scalar twin) and, where Highway is found, as vector code
// that is chosen for the processor at run time. Both do the same arithmetic in the same order and
// give the same bits.

namespace tetralight::detail {

/// Tetrahedra that a query of a block tests before its walk is left unresolved.
inline constexpr uint32_t kWalkLimit = 256;

/// Queries that are processed together. They belong to a few streams; the walks of one stream
/// follow each other, those of different streams run interleaved so that one computes while
/// another waits for memory.
struct QueryBlock {
    static constexpr size_t kStreamCount = 4;
    static constexpr size_t kStreamSize = 64;
    static constexpr size_t kSize = kStreamCount * kStreamSize;

    /// Local positions. Stream s has queries [s · kStreamSize, + count[s]).
    std::array<double, kSize> x, y, z;
    /// The tetrahedron where the walk of a query begins, at `start_index`; kNoIndex: where the
    /// stream is. Behind the last query of each stream stands one more, kNoIndex, that is read.
    std::array<uint32_t, kSize + kStreamCount> start;
    std::array<size_t, kStreamCount> count{};
    /// Where each stream is: a tetrahedron.
    std::array<uint32_t, kStreamCount> cell{};

    [[nodiscard]] static constexpr size_t start_index(size_t query, size_t stream) {
        return query + stream;
    }

    /// Out: where queries are.
    std::array<CellLocation, kSize> location;
    /// Out: unresolved queries, whose walk left the tetrahedra or needs the general code, and the
    /// cell that it reached.
    std::array<uint32_t, kSize> unresolved;
    std::array<uint32_t, kSize> unresolved_cell;
    size_t unresolved_count = 0;
    /// Out: cells tested.
    uint64_t step_count = 0;
};

/// Hull cells relative to one query each, side by side.
struct HullLanes {
    static constexpr size_t kCount = 8;

    template <class T>
    using Lanes = std::array<T, kCount>;

    /// Corner (ray) i, coordinate k: [i][k].
    alignas(64) std::array<std::array<Lanes<double>, 3>, 3> corners{};
    alignas(64) std::array<std::array<Lanes<double>, 3>, 3> rays{};
    /// Out: as `hull_cell_weights`.
    alignas(64) std::array<Lanes<double>, 3> weights{};
    /// Out: false if the cell gives no weights, or only `hull_cell_weights` can find them.
    Lanes<bool> is_known{};
};

/// Output of blended probes: location i is answer `answers[i]`.
struct BlendTarget {
    std::span<const uint32_t> answers;
    const ShOutput& irradiance;
    const OcclusionOutput& occlusion;
};

struct QueryKernels {
    /// Walks through the tetrahedra of a volume of dimension Space, until a position is found or
    /// its walk is left unresolved.
    void (*walk_tetrahedra)(const ProbeVolumeView& volume, QueryBlock& block);
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
