// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The volume to refine, and the errors of the sensors in it.
struct RefineInput {
    std::span<const uint32_t> probes;  ///< indices in the pool
    const ProbeVolume& volume;         ///< of the probes
    std::span<const uint32_t> sensors;
    std::span<const SensorError> errors;  ///< one for each sensor
    SensorView view;
};

struct RefineRule {
    /// Minimum distance of new probes from others, metres.
    double clearance = 0.0;
    /// Returns true if a sensor, an index in the pool, may become a probe; called from many
    /// threads.
    std::function<bool(uint32_t sensor)> may_become_probe;
    /// The maximum number of new probes.
    size_t max_count = 0;
    uint32_t thread_count = 0;
};

/// New probes, as sensors of the pool, those that help most first. Of the cells that cost most
/// (`SensorError::cost`) a few sensors are tried each: the costs of the sensors around are computed
/// in the tetrahedralization of the probes around, with the new one and without it.
[[nodiscard]] std::vector<uint32_t> refine_cells(const RefineInput& input, const RefineRule& rule);

}  // namespace tetralight
