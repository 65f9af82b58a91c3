// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/bake/lights/openings.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// The openings of a scene, in render space: its portals, oriented by rays towards the side that
/// sees less of the sky, and those that `find_openings` finds elsewhere. None if no light can enter
/// through them: the scene has neither a sky nor directional lights that are baked.
[[nodiscard]] std::vector<Opening> openings_of(const Scene& scene, const TraceScene& trace_scene);

}  // namespace tetralight
