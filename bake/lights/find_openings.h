// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/bake/lights/openings.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// Finds windows, doors and arches through which enclosed places see the sky: where rays that leave
/// such places are closest to surfaces before they escape. Each opening is a rectangle around the
/// hole in the plane of these points; large ones, which are met by chance, are left out. Takes up
/// to 300 000 rays and searches for the nearest surface. A pure function of the scene.
[[nodiscard]] std::vector<Opening> find_openings(const TraceScene& trace_scene);

}  // namespace tetralight
