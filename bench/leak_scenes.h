// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight::bench {

/// Positions at which leaks are measured are at least so far from all surfaces, metres.
inline constexpr float kLeakMargin = 0.05f;

/// Each of the two rooms is kRoomWide × kRoomHigh × kRoomWide metres.
inline constexpr float kRoomWide = 4.0f, kRoomHigh = 3.0f;

/// Two closed rooms side by side: the lit one at x < 0 has a lamp under its ceiling, the other is
/// dark. The wall between them is at x = 0; without thickness it is one double-sided surface.
[[nodiscard]] Scene two_rooms(float thickness);

/// A closed house under a sky and a sun, with a door of 1 × 2.1 m: walls, floor and roof of 20 cm,
/// the ground around it.
[[nodiscard]] Scene house_with_door();

/// What the house encloses: 6 × 3 × 5 m.
[[nodiscard]] WorldBox house_inside();

/// Random positions in a box that are outside geometry and at least kLeakMargin off the box and
/// surfaces.
[[nodiscard]] std::vector<glm::dvec3> free_places(const Scene& scene, const WorldBox& box,
                                                  size_t count);

}  // namespace tetralight::bench
