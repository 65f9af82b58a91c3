// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/room_box.h>

#include "tests/bake/placement/room_scenes.h"

namespace tetralight {
namespace {

constexpr double kClearance = 0.2;
const WorldBox kRoom{{0, 0, 0}, {5, 2.5, 4}};

/// Of the largest room in the bounds.
RoomBox box_of(const Scene& scene, const WorldBox& bounds = kRoom) {
    const TraceScene traced = test::traced(scene);
    const RoomMap map = find_rooms(traced, {bounds, kClearance});
    EXPECT_FALSE(map.rooms.empty());
    if (map.rooms.empty()) return {};
    return fit_room_box(traced, map, map.rooms[0], kClearance);
}

void expect_box(const WorldBox& found, const WorldBox& expected, double tolerance) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.min[axis], expected.min[axis], tolerance) << axis;
        EXPECT_NEAR(found.max[axis], expected.max[axis], tolerance) << axis;
    }
}

Scene room() {
    Scene scene;
    test::add_room(scene, {0, 0, 0}, {5, 2.5f, 4});
    return scene;
}

TEST(RoomBox, EndsAtTheWalls) {
    const RoomBox found = box_of(room());
    expect_box(found.box, kRoom, 1e-4);
    EXPECT_EQ(found.wall_count, 6);
}

TEST(RoomBox, FurnitureDoesNotShrinkIt) {
    Scene scene = room();
    test::add_solid(scene, {0, 0, 0.2f}, {0.6f, 2.1f, 2.6f});      // wardrobe
    test::add_solid(scene, {2, 0.7f, 1.5f}, {3.6f, 0.75f, 2.3f});  // table
    test::add_solid(scene, {1, 0, 3.1f}, {3, 0.8f, 4});            // sofa
    expect_box(box_of(scene).box, kRoom, 1e-4);
}

TEST(RoomBox, ANicheDoesNotWidenIt) {
    Scene scene;  // a window 1.2 m wide and high, 40 cm deep, in the wall at x = 5
    test::add_room(scene, {0, 0, 0}, {5.4f, 2.5f, 4});
    test::add_solid(scene, {5, 0, 0}, {5.4f, 0.9f, 4});
    test::add_solid(scene, {5, 2.1f, 0}, {5.4f, 2.5f, 4});
    test::add_solid(scene, {5, 0.9f, 0}, {5.4f, 2.1f, 1.4f});
    test::add_solid(scene, {5, 0.9f, 2.6f}, {5.4f, 2.1f, 4});
    expect_box(box_of(scene, {{0, 0, 0}, {5.4, 2.5, 4}}).box, kRoom, 1e-4);
}

TEST(RoomBox, HoldsBothLegsOfAnL) {
    Scene scene;
    test::add_room(scene, {0, 0, 0}, {6, 2.5f, 6});
    test::add_solid(scene, {3, 0, 3}, {6, 2.5f, 6});
    expect_box(box_of(scene, {{0, 0, 0}, {6, 2.5, 6}}).box, {{0, 0, 0}, {6, 2.5, 6}}, 1e-4);
}

TEST(RoomBox, AnOpenSideEndsWithThePoints) {
    Scene scene = room();
    scene.instances.erase(scene.instances.begin() + 3);  // the wall at x = 5
    const RoomBox found = box_of(scene);
    expect_box(found.box, kRoom, 0.125);
    EXPECT_NEAR(found.box.min.x, 0.0, 1e-4);
    EXPECT_EQ(found.wall_count, 5);
}

TEST(RoomBox, ASlopedRoofIsMetAboveItsMiddle) {
    Scene scene = room();  // a roof that falls from 4.5 m at x = 0 to 2.5 m at x = 5
    scene.instances.erase(scene.instances.begin() + 1);
    const Material roof = test::diffuse(glm::vec3(0.5f));
    test::add_quad(scene, roof, {-1, 4.9f, -1}, {7, -2.8f, 0}, {0, 0, 6});
    for (const float z : {-0.2f, 4.0f}) test::add_solid(scene, {-1, 2.5f, z}, {6, 5, z + 0.2f});
    test::add_solid(scene, {-0.2f, 2.5f, -1}, {0, 5, 5});
    const RoomBox found = box_of(scene, {{0, 0, 0}, {5, 4.5, 4}});
    // A quarter of the floor has a higher roof: at x = 1.25.
    EXPECT_NEAR(found.box.max.y, 4.0, 0.1);
    EXPECT_NEAR(found.box.min.x, 0.0, 1e-4);
}

TEST(RoomBox, PartsOfOneRoomShareAnOpenSide) {
    RoomBox left, right;
    left.box = {{0, 0, 0}, {2, 3, 4}};
    right.box = {{2.1, 0, 0}, {5, 3, 4}};
    left.is_max_open.x = right.is_min_open.x = true;
    EXPECT_TRUE(are_parts_of_one_room(left, right, 0.25));
    EXPECT_TRUE(are_parts_of_one_room(right, left, 0.25));
    EXPECT_FALSE(are_parts_of_one_room(left, right, 0.05));
    right.box.max.z = 3;  // three quarters of the side
    EXPECT_FALSE(are_parts_of_one_room(left, right, 0.25));
    right.box.max.z = 4;
    right.is_min_open.x = false;  // a wall
    EXPECT_FALSE(are_parts_of_one_room(left, right, 0.25));
}

}  // namespace
}  // namespace tetralight
