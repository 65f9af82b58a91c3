// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/bake/scene/scene.h>

namespace tetralight::bench {

/// A closed building of three furnished rooms in a row, 10 × 3 × 5 m inside, under a sky and a sun.
/// Walls, floor and ceiling are 20 cm thick, doors of 0.8 × 2.1 m join the rooms. Light enters the
/// first room through a pane of glass and the last one through a window with bars; nothing else
/// leads outside. All solids are closed boxes.
[[nodiscard]] Scene furnished_interior();

/// A free position in the first room.
[[nodiscard]] glm::dvec3 place_in_interior();

}  // namespace tetralight::bench
