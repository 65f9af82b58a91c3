// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/bake/lights/openings.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// The openings of a scene that let in most light, at most `Openings::kMaxCount`, in render space:
/// its portals, turned by rays towards the side that sees less of the sky, and those that
/// `find_openings` finds elsewhere. Those whose sides see about as much of it are left out. None if
/// the scene has neither a sky nor directional lights that are baked.
[[nodiscard]] std::vector<Opening> openings_of(const Scene& scene, const TraceScene& trace_scene);

}  // namespace tetralight
