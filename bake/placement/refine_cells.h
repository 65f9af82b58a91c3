// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The volume to refine, and the errors of the sensors in it.
struct RefineInput {
    const ProbeVolume& volume;
    const LightPool& pool;
    std::span<const uint32_t> sensors;
    std::span<const SensorError> errors;  ///< one for each sensor
    const TraceScene& traced;
};

struct RefineRule {
    /// Minimum distance of probes to surfaces, metres.
    double clearance = 0.0;
    /// Returns true if a sensor, an index in the pool, may become a probe.
    std::function<bool(uint32_t sensor)> may_become_probe;
    /// Returns true if a new position may have a probe.
    std::function<bool(const glm::dvec3& position)> is_allowed;
    /// The maximum number of cells to refine.
    size_t max_cell_count = 0;
};

/// New probes: sensors of the pool, and positions that are not in the pool.
struct Refinement {
    std::vector<uint32_t> sensors;
    std::vector<glm::dvec3> positions;

    [[nodiscard]] size_t count() const { return sensors.size() + positions.size(); }
};

/// Refines the cells with the largest errors. If the light of the visible corners is wrong, adds a
/// probe at the worst sensor of the cell. If light leaks through a wall, adds a pair of probes on
/// both sides of the wall, where the line to the hidden corner intersects it: then the edges
/// through the wall are short, and the cells beside them are on one side.
[[nodiscard]] Refinement refine_cells(const RefineInput& input, const RefineRule& rule);

/// Positions on both sides of the first surface between two world positions, at `clearance` from
/// it: through a sheet, or through a solid of at most `thickness`. Fewer than two if there is no
/// surface, or no space behind it.
[[nodiscard]] std::vector<glm::dvec3> pair_at_wall(const TraceScene& traced, const glm::dvec3& from,
                                                   const glm::dvec3& to, double clearance,
                                                   double thickness);

}  // namespace tetralight
