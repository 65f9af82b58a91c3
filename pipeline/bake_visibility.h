// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// What `bake_visibility` found.
struct VisibilityReport {
    uint64_t edge_count = 0;  ///< directed
    uint64_t blocked_edge_count = 0;
    uint64_t marked_cell_count = 0;
    /// Cells in which a surface blocks rays and edges cannot tell: one that meets no edge, as a
    /// pillar inside the cell, or that is far from planar.
    uint64_t unclear_cell_count = 0;
    /// Probes whose virtual offset leads through a wall: nothing hides them.
    uint64_t left_out_count = 0;
    uint64_t ray_count = 0;
    double seconds = 0.0;

    bool operator==(const VisibilityReport&) const = default;
};

/// Finds by rays which edges of a volume surfaces block, as seen from where each probe samples its
/// light, and stores their ratios in the cells (probes/edge_visibility.h). Ratios of free edges in
/// cells that are partly hidden are fitted to rays. The same input gives the same bytes.
/// Precondition: one capture position a probe, world space.
VisibilityReport bake_visibility(const TraceScene& traced,
                                 std::span<const glm::dvec3> capture_positions,
                                 uint32_t thread_count, ProbeVolume& volume);

}  // namespace tetralight
