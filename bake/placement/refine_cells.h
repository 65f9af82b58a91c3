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

/// What a volume is refined with.
struct RefineInput {
    const ProbeVolume& volume;
    const LightPool& pool;
    std::span<const uint32_t> sensors;
    std::span<const SensorError> errors;  ///< one a sensor
    const TraceScene& traced;
};

struct RefineRule {
    /// Metres that probes keep from surfaces.
    double clearance = 0.0;
    /// Whether a probe may stand at a sensor, by its number in the pool.
    std::function<bool(uint32_t sensor)> may_become_probe;
    /// Whether one may stand at a new position.
    std::function<bool(const glm::dvec3& position)> is_allowed;
    /// Cells that are refined at once.
    size_t max_cell_count = 0;
};

/// New probes: at sensors of the pool, and at positions that are not in it yet.
struct Refinement {
    std::vector<uint32_t> sensors;
    std::vector<glm::dvec3> positions;

    [[nodiscard]] size_t count() const { return sensors.size() + positions.size(); }
};

/// Chooses the cells with the largest errors. Where the light of the corners in sight is wrong, a
/// probe goes to the worst sensor of the cell. Where it comes through a wall, a pair goes to both
/// sides of the wall, where the line to the hidden corner is cut: then the edges between the two
/// sides are short, and cells beside them lie on one side.
[[nodiscard]] Refinement refine_cells(const RefineInput& input, const RefineRule& rule);

/// Positions on both sides of the first surface between two world positions, `clearance` off it:
/// through a sheet, or through a solid of at most `thickness`. Fewer where there is nothing between
/// or no room behind.
[[nodiscard]] std::vector<glm::dvec3> pair_at_wall(const TraceScene& traced, const glm::dvec3& from,
                                                   const glm::dvec3& to, double clearance,
                                                   double thickness);

}  // namespace tetralight
