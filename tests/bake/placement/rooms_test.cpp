// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/rooms.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/bake/placement/room_scenes.h"

namespace tetralight {
namespace {

constexpr double kClearance = 0.2;
const WorldBox kTwoRooms{{0, 0, 0}, {8.2, 2.5, 4}};

RoomMap rooms_of(const Scene& scene, const WorldBox& bounds) {
    return find_rooms(test::traced(scene), {bounds, kClearance});
}

double volume_of(const RoomMap& map, size_t room) {
    return static_cast<double>(map.rooms[room].size()) * map.point_volume();
}

/// Of the points at the clearance or farther from the walls of a box.
double free_volume(double x, double y, double z) {
    return (x - 2 * kClearance) * (y - 2 * kClearance) * (z - 2 * kClearance);
}

TEST(Rooms, ADoorSeparatesTwo) {
    const RoomMap map = rooms_of(test::two_rooms(0.9f, 2.0f), kTwoRooms);
    ASSERT_EQ(map.rooms.size(), 2u);
    // Half of the passage each: 0.5 m × 1.6 m × 0.6 m of it are free.
    const double expected = free_volume(4, 2.5, 4) + 0.5 * (0.5 * 1.6 * 0.6);
    EXPECT_NEAR(volume_of(map, 0), expected, 0.15 * expected);
    EXPECT_NEAR(volume_of(map, 1), expected, 0.15 * expected);
    const bool is_first_left = map.lattice.at(map.rooms[0].front()).x < 4.1;
    for (size_t room = 0; room < 2; ++room) {
        const bool is_left = (room == 0) == is_first_left;
        for (const uint32_t point : map.rooms[room]) {
            const double x = map.lattice.at(point).x;
            EXPECT_LT(is_left ? x : 8.2 - x, 4.5);
        }
    }
}

TEST(Rooms, AnOpeningAsWideAsTheRoomIsHighSeparatesNone) {
    EXPECT_EQ(rooms_of(test::two_rooms(2.5f, 2.5f), kTwoRooms).rooms.size(), 1u);
}

TEST(Rooms, DoNotDependOnWhereTheLatticeStands) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0.0, 0.3);
    for (int i = 0; i < 10; ++i) {
        WorldBox bounds = kTwoRooms;
        bounds.min -= glm::dvec3(part(random), part(random), part(random));
        bounds.max += glm::dvec3(part(random), part(random), part(random));
        EXPECT_EQ(rooms_of(test::two_rooms(0.9f, 2.0f), bounds).rooms.size(), 2u) << i;
        EXPECT_EQ(rooms_of(test::two_rooms(3.0f, 2.5f), bounds).rooms.size(), 1u) << i;
    }
}

TEST(Rooms, ACorridorIsARoomOfItsOwn) {
    Scene scene;  // 1.4 m wide, with a door of 90 cm to a room
    test::add_room(scene, {0, 0, 0}, {6, 2.5f, 5.6f});
    test::add_solid(scene, {0, 0, 1.4f}, {2.5f, 2.5f, 1.6f});
    test::add_solid(scene, {3.4f, 0, 1.4f}, {6, 2.5f, 1.6f});
    test::add_solid(scene, {2.5f, 2, 1.4f}, {3.4f, 2.5f, 1.6f});
    const RoomMap map = rooms_of(scene, {{0, 0, 0}, {6, 2.5, 5.6}});
    ASSERT_EQ(map.rooms.size(), 2u);
    EXPECT_NEAR(volume_of(map, 0), free_volume(6, 2.5, 4), 0.15 * free_volume(6, 2.5, 4));
    EXPECT_NEAR(volume_of(map, 1), free_volume(6, 2.5, 1.4), 0.25 * free_volume(6, 2.5, 1.4));
}

TEST(Rooms, SmallOnesAreLeftOut) {
    Scene scene;  // a cupboard: 1.2 m³
    test::add_room(scene, {0, 0, 0}, {1, 1.2f, 1});
    EXPECT_TRUE(rooms_of(scene, {{-1, -1, -1}, {2, 3, 2}}).rooms.empty());
}

TEST(Rooms, WhatHasNoCeilingIsOpen) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 3.0f);
    const RoomMap map = rooms_of(scene, {{-3, 0, -3}, {3, 2, 3}});
    EXPECT_TRUE(map.rooms.empty());
    EXPECT_NEAR(static_cast<double>(map.open_points.size()) * map.point_volume(), 6 * 1.8 * 6, 4.0);
    EXPECT_TRUE(std::ranges::is_sorted(map.open_points));
}

TEST(Rooms, LargeBoundsHaveACoarserLattice) {
    Scene scene;
    test::add_room(scene, {0, 0, 0}, {80, 10, 80});
    const RoomMap map = rooms_of(scene, {{0, 0, 0}, {80, 10, 80}});
    EXPECT_LE(map.lattice.count(), uint64_t{1} << 20);
    EXPECT_GT(map.lattice.count(), uint64_t{1} << 19);
    ASSERT_EQ(map.rooms.size(), 1u);
    EXPECT_NEAR(volume_of(map, 0), free_volume(80, 10, 80), 0.05 * free_volume(80, 10, 80));
}

}  // namespace
}  // namespace tetralight
