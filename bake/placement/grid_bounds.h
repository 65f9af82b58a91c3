// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// The box to fill: what is given, or around the nodes that are named, or around all that
/// contributes global illumination. A node's box is that of all below it. Errors: a name that no
/// node has, or none that has a mesh, and nothing to take bounds from.
[[nodiscard]] Result<WorldBox> grid_bounds(const Scene& scene, const ProbeGridSettings& settings);

/// The box with room for what the mode puts around the scene's surfaces: flat scenes have air above
/// them, layers stand above the highest floor, and surfaces have outer sides. A box that is given
/// stays as it is.
[[nodiscard]] WorldBox padded_bounds(const WorldBox& bounds, const glm::dvec3& spacing,
                                     double clearance, const ProbeGridSettings& settings);

/// Whether a position lies in a box, rounding aside.
[[nodiscard]] bool is_in(const WorldBox& box, const glm::dvec3& position);

/// The most probes that are allowed.
[[nodiscard]] uint64_t probe_limit(const ProbeGridSettings& settings);

/// Metres between the candidates. The adaptive mode's are an eighth of the longest side when it is
/// not told, and farther apart where they would be more than half of its probes. Errors: those of
/// `lattice_count`, and what is beyond reason.
[[nodiscard]] Result<glm::dvec3> candidate_spacing(const WorldBox& bounds,
                                                   const ProbeGridSettings& settings);

/// Metres that probes keep from surfaces. Error: it is negative or not finite.
[[nodiscard]] Result<double> checked_clearance(const glm::dvec3& spacing,
                                               const ProbeGridSettings& settings);

}  // namespace tetralight
