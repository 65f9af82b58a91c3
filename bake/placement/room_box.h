// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/placement/rooms.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// The box of a room along the world's axes.
struct RoomBox {
    WorldBox box;
    /// How many of the six sides are walls (floors, ceilings) for the most part.
    int wall_count = 0;
    /// The sides at the box's minimum and maximum that are hardly walls.
    glm::bvec3 is_min_open{false}, is_max_open{false};
};

/// Fits a box to the walls of a room: along each axis, rays go from the last point of each row of
/// points on to the wall. Of all walls of a side, the box takes the outermost one that a quarter of
/// the rays hit, so that neither furniture nor niches count. Rays that hit nothing nearby, as in
/// doors, are left out; a side where most do so ends with the points. `clearance` as in `RoomRule`.
/// Precondition: the room has points.
[[nodiscard]] RoomBox fit_room_box(const TraceScene& traced, const RoomMap& map,
                                   const std::vector<uint32_t>& room, double clearance);

/// True if two boxes are parts of one: they have an open side of about the same size in common.
/// `gap`: how far apart these sides may be, metres.
[[nodiscard]] bool are_parts_of_one_room(const RoomBox& a, const RoomBox& b, double gap);

}  // namespace tetralight
