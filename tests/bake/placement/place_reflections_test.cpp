// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/place_reflections.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/rooms.h>
#include "tests/bake/placement/grid_support.h"
#include "tests/bake/placement/room_scenes.h"

namespace tetralight {
namespace {

const WorldBox kRoom{{0, 0, 0}, {5, 2.5, 4}};
const WorldBox kGarden{{-20, 0, -20}, {20, 8, 20}};

std::vector<ReflectionPlace> places_of(const Scene& scene, const WorldBox& bounds,
                                       uint32_t thread_count = 0) {
    ReflectionRule rule;
    rule.bounds = bounds;
    rule.adjustments = scene.probe_adjustments;
    rule.thread_count = thread_count;
    const TraceScene traced = test::traced(scene);
    std::vector<ReflectionPlace> places = place_reflections(traced, rule);
    for (const ReflectionPlace& place : places) {
        EXPECT_TRUE(check_reflection_place(place)) << place.name;
        EXPECT_TRUE(is_free_with_clearance(traced, place.position, 0.2)) << place.name;
    }
    return places;
}

WorldBox box_of(const ReflectionPlace& place) {
    const glm::dvec3 center = place.position + glm::dvec3(place.box_center);
    return {center - glm::dvec3(place.half_size), center + glm::dvec3(place.half_size)};
}

void expect_box(const ReflectionPlace& place, const WorldBox& expected) {
    EXPECT_LT(glm::distance(box_of(place).min, expected.min), 1e-3) << place.name;
    EXPECT_LT(glm::distance(box_of(place).max, expected.max), 1e-3) << place.name;
}

Scene closed_room() {
    Scene scene;
    test::add_room(scene, {0, 0, 0}, {5, 2.5f, 4});
    return scene;
}

ProbeAdjustment no_probes_in(const WorldBox& box) {
    ProbeAdjustment adjustment;
    adjustment.name = "none";
    adjustment.world_from_volume =
        glm::scale(glm::translate(glm::dmat4(1.0), box.center()), box.size());
    adjustment.forbids_probes = true;
    return adjustment;
}

TEST(PlaceReflections, AClosedRoomHasOneInItsMiddle) {
    const auto places = places_of(closed_room(), kRoom);
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], kRoom);
    EXPECT_LT(glm::distance(places[0].position, kRoom.center()), 1e-3);
    EXPECT_EQ(places[0].name, "room 1");
    EXPECT_EQ(places[0].importance, 2);
    EXPECT_NEAR(places[0].blend_distance, 0.25f, 1e-4f);
    EXPECT_EQ(places[0].near_distance, 0.0f);
    EXPECT_EQ(places[0].axes, glm::mat3(1.0f));
}

TEST(PlaceReflections, WallsMayBeSheets) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Inward, {0, 0, 0},
                  {5, 2.5f, 4});
    const auto places = places_of(scene, kRoom);
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], kRoom);
}

TEST(PlaceReflections, EachOfTwoRoomsWithADoorHasOne) {
    const auto places = places_of(test::two_rooms(0.9f, 2.0f), {{0, 0, 0}, {8.2, 2.5, 4}});
    ASSERT_EQ(places.size(), 2u);
    const bool is_first_left = places[0].position.x < 4.1;
    expect_box(places[is_first_left ? 0 : 1], {{0, 0, 0}, {4, 2.5, 4}});
    expect_box(places[is_first_left ? 1 : 0], {{4.2, 0, 0}, {8.2, 2.5, 4}});
}

TEST(PlaceReflections, EachRoomOfAHouseHasOne) {
    const Scene house = test::house();
    auto places = places_of(house, {{-3, -0.2, -3}, {15, 7, 11}});
    std::erase_if(places, [](const ReflectionPlace& place) { return place.importance == 1; });
    ASSERT_EQ(places.size(), 12u);
    for (int i = 0; i < 12; ++i) {
        const int x = i % 3, z = i / 3 % 2, y = i / 6;
        const WorldBox room{{4.0 * x + 0.1, 3.0 * y, 4.0 * z + 0.1},
                            {4.0 * x + 3.9, y == 0 ? 2.8 : 6.0, 4.0 * z + 3.9}};
        const auto found = std::ranges::find_if(
            places, [&](const ReflectionPlace& place) { return contains(room, place.position); });
        ASSERT_NE(found, places.end()) << i;
        expect_box(*found, room);
    }
}

TEST(PlaceReflections, AnLShapedRoomHasOneInsideIt) {
    Scene scene;
    test::add_room(scene, {0, 0, 0}, {6, 2.5f, 6});
    test::add_solid(scene, {2.5f, 0, 2.5f}, {6, 2.5f, 6});  // the middle of the box is inside
    const auto places = places_of(scene, {{0, 0, 0}, {6, 2.5, 6}});
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], {{0, 0, 0}, {6, 2.5, 6}});
    // The free position nearest to the middle is 50 cm from the solid's edge.
    EXPECT_LT(glm::distance(places[0].position, glm::dvec3(3, 1.25, 3)), 0.5 + 0.5 * 1.42 + 0.2);
}

TEST(PlaceReflections, FurnitureMovesItAndDoesNotShrinkItsBox) {
    Scene scene = closed_room();
    test::add_solid(scene, {0, 0, 0.2f}, {0.6f, 2.1f, 2.6f});     // wardrobe
    test::add_solid(scene, {2.2f, 0, 1.7f}, {2.8f, 2.5f, 2.3f});  // pillar, in the middle
    const auto places = places_of(scene, kRoom);
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], kRoom);
    // 50 cm off the pillar, a step of the lattice more at most.
    const double away = glm::distance(places[0].position, kRoom.center());
    EXPECT_GE(away, 0.8 - 1e-3);
    EXPECT_LE(away, 0.8 + 0.22);
}

TEST(PlaceReflections, APillarDoesNotPartARoom) {
    Scene scene;  // the ways beside it are half as wide as the room
    test::add_room(scene, {0, 0, 0}, {3, 3, 8});
    test::add_solid(scene, {1.35f, 0, 3.85f}, {1.65f, 3, 4.15f});
    const WorldBox room{{0, 0, 0}, {3, 3, 8}};
    EXPECT_EQ(find_rooms(test::traced(scene), {room, 0.2}).rooms.size(), 2u);
    const auto places = places_of(scene, room);
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], room);
}

TEST(PlaceReflections, OutdoorsTheyAreASpacingApart) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f);
    const auto places = places_of(scene, kGarden);
    ASSERT_EQ(places.size(), 16u);
    for (size_t i = 0; i < places.size(); ++i) {
        const double x = -15.0 + 10.0 * static_cast<double>(i % 4);
        const double z = -15.0 + 10.0 * static_cast<double>(i / 4);
        EXPECT_LT(glm::distance(places[i].position, glm::dvec3(x, 2, z)), 0.3) << i;
        EXPECT_EQ(places[i].importance, 1);
        const WorldBox box = box_of(places[i]);
        EXPECT_NEAR(box.min.y, 0.0, 1e-3);
        EXPECT_NEAR(box.max.y, 8.0, 1e-3);
        EXPECT_NEAR(places[i].blend_distance, 0.8f, 1e-3f);
        EXPECT_NEAR(box.size().x, 10.0, 1e-3);
        EXPECT_NEAR(box.size().z, 10.0, 1e-3);
    }
    EXPECT_EQ(places.back().name, "outdoors 16");
}

TEST(PlaceReflections, WhereThereIsNoGroundThereAreNone) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 10.0f);
    const auto places = places_of(scene, kGarden);
    ASSERT_EQ(places.size(), 4u);
    for (const ReflectionPlace& place : places) {
        EXPECT_LT(std::max(std::abs(place.position.x), std::abs(place.position.z)), 10.0);
    }
}

TEST(PlaceReflections, OutdoorsTheyStandAboveTheGroundBesideATower) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f, 1.0f);
    test::add_solid(scene, {3, 1, 3}, {7, 8, 7});  // in the middle of a square
    const auto places = places_of(scene, {{-20, 1, -20}, {20, 9, 20}});
    ASSERT_EQ(places.size(), 16u);
    for (const ReflectionPlace& place : places) EXPECT_NEAR(place.position.y, 3.0, 0.2);
    const auto beside = std::ranges::find_if(places, [](const ReflectionPlace& place) {
        return contains(WorldBox{{0, 0, 0}, {10, 9, 10}}, place.position);
    });
    ASSERT_NE(beside, places.end());
    EXPECT_LT(glm::distance(beside->position, glm::dvec3(5, 3, 5)), 2.5 + 0.7);
}

TEST(PlaceReflections, AHouseInAGardenHasBothKinds) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f);
    test::add_room(scene, {1, 0.2f, 1}, {7, 2.9f, 6});
    const auto places = places_of(scene, kGarden);
    ASSERT_EQ(places.size(), 17u);
    EXPECT_EQ(places[0].name, "room 1");
    expect_box(places[0], {{1, 0.2, 1}, {7, 2.9, 6}});
    for (size_t i = 1; i < places.size(); ++i) {
        EXPECT_EQ(places[i].importance, 1);
        EXPECT_FALSE(contains(box_of(places[0]), places[i].position));
    }
}

TEST(PlaceReflections, NoBoxOfAnArcadeHoldsItsCourt) {
    Scene scene;  // 3 m wide and 3 m high, around a court of 10 m × 10 m
    test::add_solid(scene, {-8.2f, -0.2f, -8.2f}, {8.2f, 0, 8.2f});
    test::add_solid(scene, {-8.2f, 3, -8.2f}, {8.2f, 3.2f, -5});
    test::add_solid(scene, {-8.2f, 3, 5}, {8.2f, 3.2f, 8.2f});
    test::add_solid(scene, {-8.2f, 3, -5}, {-5, 3.2f, 5});
    test::add_solid(scene, {5, 3, -5}, {8.2f, 3.2f, 5});
    for (const float side : {-8.2f, 8.0f}) {
        test::add_solid(scene, {side, 0, -8.2f}, {side + 0.2f, 3, 8.2f});
        test::add_solid(scene, {-8.2f, 0, side}, {8.2f, 3, side + 0.2f});
    }
    const WorldBox court{{-5, 0, -5}, {5, 6, 5}};
    const auto places = places_of(scene, {{-8.2, -0.2, -8.2}, {8.2, 6, 8.2}});
    int rooms = 0;
    for (const ReflectionPlace& place : places) {
        if (place.importance != 2) continue;
        ++rooms;
        EXPECT_FALSE(contains(court, place.position)) << place.name;
        const glm::dvec3 shared = intersection_of(court, box_of(place)).size();
        const glm::dvec3 all = box_of(place).size();
        EXPECT_LT(shared.x * shared.z, 0.25 * all.x * all.z) << place.name;
    }
    EXPECT_GE(rooms, 4);
    EXPECT_LE(rooms, 8);
    EXPECT_TRUE(std::ranges::any_of(places, [&](const ReflectionPlace& place) {
        return place.importance == 1 && contains(court, place.position);
    }));
}

TEST(PlaceReflections, ANarrowShaftHasNone) {
    Scene scene;
    test::add_room(scene, {0, 0, 0}, {0.7f, 4, 4});
    EXPECT_TRUE(places_of(scene, {{0, 0, 0}, {0.7, 4, 4}}).empty());
}

TEST(PlaceReflections, ABridgeIsNoRoom) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f);
    test::add_solid(scene, {-4, 3, -20}, {4, 3.5f, 20});
    for (const ReflectionPlace& place : places_of(scene, kGarden)) EXPECT_EQ(place.importance, 1);
}

TEST(PlaceReflections, ASceneWithoutSurfacesHasNone) {
    EXPECT_TRUE(places_of(Scene{}, kRoom).empty());
}

TEST(PlaceReflections, AreTheSameForAllNumbersOfThreads) {
    Scene scene = test::two_rooms(0.9f, 2.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 12.0f, -0.2f);
    const WorldBox bounds{{-12, -0.2, -12}, {12, 5, 12}};
    const auto places = places_of(scene, bounds, 1);
    EXPECT_GT(places.size(), 6u);
    for (const uint32_t threads : {2u, 3u, 8u})
        EXPECT_EQ(places_of(scene, bounds, threads), places);
}

TEST(PlaceReflections, AVolumeForbidsThem) {
    Scene scene = closed_room();
    scene.probe_adjustments = {no_probes_in({{1.5, 0, 1}, {3.5, 2.5, 3}})};
    const auto places = places_of(scene, kRoom);
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], kRoom);
    EXPECT_FALSE(contains(scene.probe_adjustments[0], places[0].position));
    EXPECT_LT(glm::distance(places[0].position, kRoom.center()), 1.0 + 0.22);
    scene.probe_adjustments = {no_probes_in(kRoom)};
    EXPECT_TRUE(places_of(scene, kRoom).empty());
}

TEST(PlaceReflections, SpacesThatAreNotFilledHaveNone) {
    const Scene scene = test::two_rooms(0.9f, 2.0f);
    ReflectionRule rule;
    rule.bounds = {{0, 0, 0}, {8.2, 2.5, 4}};
    rule.is_filled = [](const glm::dvec3& position) { return position.x < 4.1; };
    const auto places = place_reflections(test::traced(scene), rule);
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], {{0, 0, 0}, {4, 2.5, 4}});
}

TEST(PlaceReflections, AGridHasThemInTheSpacesThatItFills) {
    Scene scene;  // two rooms that no door joins
    test::add_room(scene, {0, 0, 0}, {5, 2.5f, 4});
    test::add_room(scene, {5.4f, 0, 0}, {8, 2.5f, 4});
    ProbeGridSettings settings = test::settings_for({{-0.2, -0.2, -0.2}, {8.2, 2.7, 4.2}}, 1.0);
    settings.from = {{7, 1, 2}};
    EXPECT_TRUE(test::grid_of(scene, settings).reflection_places.empty());
    settings.reflection_spacing = 10.0;
    const auto places = test::grid_of(scene, settings).reflection_places;
    ASSERT_EQ(places.size(), 1u);
    expect_box(places[0], {{5.4, 0, 0}, {8, 2.5, 4}});
    settings.reflection_spacing = 0.0;
    EXPECT_EQ(test::error_of(scene, settings), "reflection_spacing 0 is not a positive length");
}

}  // namespace
}  // namespace tetralight
