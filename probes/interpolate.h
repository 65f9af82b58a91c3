// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/query_output.h>
#include <tetralight/probes/receiver.h>

// Interpolates the light at positions: of one object, or of a million instances in one call.
//
//     std::vector<PackedSh> light(positions.size());
//     auto report = interpolate(volume, {.positions = positions, .irradiance = light});

namespace tetralight {

/// The interpolated light at one position.
struct InterpolatedProbe {
    IrradianceSh irradiance;
    /// Four channels, 1 = lit.
    glm::vec4 occlusion{1.0f};

    bool operator==(const InterpolatedProbe&) const = default;
};

/// Blends the probes of a located cell. Without a cell, or without baked light, the answer is the
/// volume's ambient light and occlusion (1, 1, 1, 1). Thread-safe.
[[nodiscard]] InterpolatedProbe interpolate(const ProbeVolumeView& volume,
                                            const CellLocation& location,
                                            const Receiver& receiver = {}) noexcept;

/// Many positions in one call.
struct InterpolationBatch {
    /// World space.
    std::span<const glm::vec3> positions;
    /// In: where each walk starts; out: the cell found, for the next frame. May be empty: then
    /// walks start at the volume's seed grid.
    std::span<uint32_t> hints = {};
    /// At least one of irradiance, occlusion and locations must be set.
    ShOutput irradiance = {};
    OcclusionOutput occlusion = {};
    OutsideHull outside = {};
    /// Scratch memory of two elements a position. If given, positions are answered along a Morton
    /// curve, which is faster for positions in random order.
    std::span<uint64_t> sort_memory = {};
    /// Out: the cell and the weights of each position, as `locate` gives them. May be empty.
    std::span<CellLocation> locations = {};
    Walls walls = Walls::HideProbes;
    /// `Receiver::rendering_layers` of each position. Empty: all layers.
    std::span<const uint32_t> rendering_layers = {};
    /// `Receiver::radius` of each position. Empty: 0.
    std::span<const float> radii = {};
    /// Unit normals of surfaces that the positions lie on: each is pushed off along its normal
    /// (`push_off_surface`), and cell, weights and light are those of the place there. Such a batch
    /// takes about twice the time, and is answered in the order of its positions. Empty: positions
    /// stay where they are.
    std::span<const glm::vec3> normals = {};
    /// The share of the mean distance to the probes that positions with normals are pushed by, ≥ 0.
    float normal_offset = kNormalOffset;
};

/// Counters of a batch.
struct BatchReport {
    /// Positions that are not finite: their answer is the ambient light.
    uint64_t not_finite_count = 0;
    /// Cells that were tested.
    uint64_t step_count = 0;
    /// Walks that ended by searching all cells.
    uint64_t fallback_count = 0;

    bool operator==(const BatchReport&) const = default;
};

/// Locates and blends every position of the batch. Thread-safe on one volume; allocates nothing.
/// `locate` documents what may differ between calls.
///
/// Returns invalid_argument if no output is set, a span is too short for `positions` (the
/// message holds both lengths), answers overlap or are not aligned, the fade distance is not
/// positive and finite, or a radius or the normal offset is negative or not finite. `Error::field`
/// is the member of the batch.
[[nodiscard]] Result<BatchReport> interpolate(const ProbeVolumeView& volume,
                                              const InterpolationBatch& batch);

/// Positions of one task of a parallel batch.
inline constexpr size_t kBatchTaskSize = 16384;

/// The positions [begin, begin + count) of a checked batch.
[[nodiscard]] InterpolationBatch part_of(const InterpolationBatch& batch, size_t begin,
                                         size_t count) noexcept;

/// Returns the errors that `interpolate` returns for a batch.
[[nodiscard]] Status check_batch(const InterpolationBatch& batch);

/// Those about `rendering_layers`, `radii`, `normals` and `normal_offset`.
[[nodiscard]] Status check_receivers(const InterpolationBatch& batch);

namespace detail {

/// The tasks of a parallel batch: task i answers kBatchTaskSize positions and adds to the counts.
struct BatchTasks {
    const ProbeVolumeView& volume;
    const InterpolationBatch& batch;
    std::atomic<uint64_t> not_finite_count = 0;
    std::atomic<uint64_t> step_count = 0;
    std::atomic<uint64_t> fallback_count = 0;

    void run(size_t task) noexcept;
};

}  // namespace detail

/// The same on the caller's threads: `parallel_for(count, task)` calls task(0) .. task(count − 1)
/// in any order, on any threads, and returns when all are done.
template <class ParallelFor>
[[nodiscard]] Result<BatchReport> interpolate(const ProbeVolumeView& volume,
                                              const InterpolationBatch& batch,
                                              ParallelFor&& parallel_for) {
    if (auto status = check_batch(batch); !status) return status.error();
    detail::BatchTasks tasks{volume, batch};
    const size_t count = (batch.positions.size() + kBatchTaskSize - 1) / kBatchTaskSize;
    parallel_for(count, [&tasks](size_t task) { tasks.run(task); });
    return BatchReport{tasks.not_finite_count, tasks.step_count, tasks.fallback_count};
}

/// Locates many positions as `interpolate` does. Precondition: as many locations as positions.
void locate(const ProbeVolumeView& volume, std::span<const glm::vec3> positions,
            std::span<CellLocation> locations, const OutsideHull& outside = {});

/// Blends at known locations: `interpolate` without the walk. Returns the same errors.
[[nodiscard]] Status blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                           const ShOutput& irradiance, const OcclusionOutput& occlusion,
                           Walls walls = Walls::HideProbes);

}  // namespace tetralight
