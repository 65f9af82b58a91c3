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

// What light arrives at a position, for one object or a million instances in one call.
//
//     std::vector<PackedSh> light(positions.size());
//     auto report = interpolate(volume, {.positions = positions, .irradiance = light});

namespace tetralight {

/// What a volume answers for one position.
struct InterpolatedProbe {
    IrradianceSh irradiance;
    /// Four channels, 1 = lit.
    glm::vec4 occlusion{1.0f};

    bool operator==(const InterpolatedProbe&) const = default;
};

/// Blends the probes of a located cell. Without a cell, or without baked light, the answer is the
/// volume's ambient light and occlusion (1, 1, 1, 1). Thread-safe.
[[nodiscard]] InterpolatedProbe interpolate(const ProbeVolumeView& volume,
                                            const CellLocation& location) noexcept;

/// Many positions in one call.
struct InterpolationBatch {
    /// World space.
    std::span<const glm::vec3> positions;
    /// In: where each walk starts; out: the cell found, for the next frame. May be empty: then
    /// walks start near the cells of the positions before them.
    std::span<uint32_t> hints = {};
    /// Either may be left out, not both.
    ShOutput irradiance = {};
    OcclusionOutput occlusion = {};
    OutsideHull outside = {};
    /// Not empty: answer along a Morton curve, which makes positions in no order faster. Two for
    /// each position; what it holds is of no use afterwards.
    std::span<uint64_t> sort_memory = {};
};

/// What a batch met.
struct BatchReport {
    /// Positions that are not finite: their answer is the ambient light.
    uint64_t not_finite_count = 0;
    /// Cells that were tested.
    uint64_t step_count = 0;
    /// Walks that did not end by themselves.
    uint64_t fallback_count = 0;

    bool operator==(const BatchReport&) const = default;
};

/// Locates and blends every position of the batch. Errors: no output at all, a span that is shorter
/// than `positions` needs (the message says both lengths), answers over each other or at odd
/// addresses, a fade that is no length. Thread-safe on one volume; allocates nothing. `locate` says
/// what may differ between calls.
[[nodiscard]] Result<BatchReport> interpolate(const ProbeVolumeView& volume,
                                              const InterpolationBatch& batch);

/// Positions of one task of a parallel batch.
inline constexpr size_t kBatchTaskSize = 16384;

/// Errors of a batch, as `interpolate` says them.
[[nodiscard]] Status check_batch(const InterpolationBatch& batch);

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

/// Locations of many positions, as `interpolate` finds them. Precondition: as many locations as
/// positions.
void locate(const ProbeVolumeView& volume, std::span<const glm::vec3> positions,
            std::span<CellLocation> locations, const OutsideHull& outside = {});

/// Blends at known locations: `interpolate` without the walk. Errors as there.
[[nodiscard]] Status blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                           const ShOutput& irradiance, const OcclusionOutput& occlusion);

}  // namespace tetralight
