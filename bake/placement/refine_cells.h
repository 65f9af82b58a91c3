// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The volume to refine, and the errors of the sensors in it.
struct RefineInput {
    const ProbeVolume& volume;
    const LightPool& pool;
    std::span<const uint32_t> sensors;
    std::span<const SensorError> errors;  ///< one for each sensor
};

struct RefineRule {
    /// Minimum distance of new probes from others, metres.
    double clearance = 0.0;
    /// Returns true if a sensor, an index in the pool, may become a probe.
    std::function<bool(uint32_t sensor)> may_become_probe;
    /// The maximum number of cells to refine.
    size_t max_cell_count = 0;
};

/// New probes, as sensors of the pool: in the cells that cost most, the sensors that cost most
/// (`SensorError::cost`). One for each cell at most.
[[nodiscard]] std::vector<uint32_t> refine_cells(const RefineInput& input, const RefineRule& rule);

}  // namespace tetralight
