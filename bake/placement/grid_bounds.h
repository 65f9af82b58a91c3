// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bake/placement/probe_grid.h"
#include "bake/scene/scene.h"
#include "bake/scene/scene_bounds.h"
#include "base/result.h"

namespace tetralight {

/// The box to fill: what is given, or around the nodes that are named, or around all that
/// contributes global illumination. Errors: a name that no node with a mesh has, and nothing to
/// take bounds from.
[[nodiscard]] Result<Box> grid_bounds(const Scene& scene, const ProbeGridSettings& settings);

/// Metres that probes keep from surfaces. Error: it is negative or not finite.
[[nodiscard]] Result<double> checked_clearance(const ProbeGridSettings& settings);

}  // namespace tetralight
