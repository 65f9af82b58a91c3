// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/placement/lattice.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Free space as the points of a lattice, and the rooms that it consists of.
struct RoomMap {
    Lattice lattice;
    /// Metres from each point to the nearest surface, up to 1.5.
    std::vector<float> distances;
    /// The points of each room, ascending; the rooms with most points first.
    std::vector<std::vector<uint32_t>> rooms;
    /// The points below nothing but the sky, ascending.
    std::vector<uint32_t> open_points;

    /// The volume for which one point stands, m³.
    [[nodiscard]] double point_volume() const;
};

/// Where to look for rooms.
struct RoomRule {
    WorldBox bounds;
    /// Points that are nearer to surfaces are not free, metres; above 0.
    double clearance = 0.2;
    uint32_t thread_count = 0;
};

/// Splits the free space below ceilings into rooms where it narrows: a watershed of the distance to
/// surfaces, as Haumont et al. 2003, "Volumetric Cell-and-Portal Generation", find rooms and doors.
/// Two parts are two rooms if the way between them is less than 0.8 times as wide as the widest
/// place of the smaller one, and narrower than 2.4 m: doors separate rooms, and furniture does not.
/// Rooms of less than 2 m³ are left out. A room may be inside geometry. The points are 12.5 cm
/// apart, or more if they would be more than a million. Deterministic.
[[nodiscard]] RoomMap find_rooms(const TraceScene& traced, const RoomRule& rule);

}  // namespace tetralight
