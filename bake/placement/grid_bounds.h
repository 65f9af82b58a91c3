// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// The box to fill: `bounds`, or the bounds of the nodes `bounds_of` with all nodes below them, or
/// the bounds of all instances that contribute global illumination. Returns not_found if no node
/// has the name, and invalid_argument if none of them has a mesh, or if there is no geometry.
[[nodiscard]] Result<WorldBox> grid_bounds(const Scene& scene, const ProbeGridSettings& settings);

/// The box with the padding that the mode needs: air above flat scenes, layers above the highest
/// floor, the clearance outside of outer walls. `settings.bounds` is not padded.
[[nodiscard]] WorldBox padded_bounds(const WorldBox& bounds, const glm::dvec3& spacing,
                                     double clearance, const ProbeGridSettings& settings);

/// True if a position is in a box, with a tolerance for rounding.
[[nodiscard]] bool is_in(const WorldBox& box, const glm::dvec3& position);

/// The maximum number of probes: `max_probes`, or its default.
[[nodiscard]] uint64_t probe_limit(const ProbeGridSettings& settings);

/// Spacing of the candidates, metres. In the adaptive mode, its default is an eighth of the longest
/// side, and it grows until the candidates are at most half of `max_probes`. Errors: those of
/// `lattice_count` and `check_candidate_count`; invalid_argument if the bounds are one point.
[[nodiscard]] Result<glm::dvec3> candidate_spacing(const WorldBox& bounds,
                                                   const ProbeGridSettings& settings);

/// Minimum distance of probes to surfaces, metres. Returns invalid_argument if it is negative or
/// not finite.
[[nodiscard]] Result<double> checked_clearance(const glm::dvec3& spacing,
                                               const ProbeGridSettings& settings);

/// Radius of the body that moves from space to space, metres. Returns invalid_argument if it is
/// negative or not finite.
[[nodiscard]] Result<double> checked_agent_radius(const glm::dvec3& spacing,
                                                  const ProbeGridSettings& settings);

}  // namespace tetralight
