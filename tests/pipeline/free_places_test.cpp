// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/free_places.h>

#include <gtest/gtest.h>

#include "tests/support/random_probes.h"
#include "tests/support/rooms.h"

namespace tetralight {
namespace {

FreePlaces find(const Scene& scene, const ProbeVolume& volume, FreePlaceSettings settings = {}) {
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    const ProbeEyes eyes = make_probe_eyes(*traced, volume.view(), settings.min_validity);
    return find_free_places(*traced, eyes, volume.view(), settings);
}

/// Probes in the first room of a row, 1.9 m apart: the box of places reaches beyond its walls.
ProbeVolume one_room_volume() {
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.05, positions);
    return test::make_lit_volume(positions);
}

/// A room whose walls have fronts on both sides, so that no ray from outside meets a back.
Scene closed_building() {
    Scene scene = test::row_of_rooms({1.0f});
    scene.materials[0].is_double_sided = true;
    return scene;
}

TEST(FreePlaces, AreNotOutsideOfAClosedBuilding) {
    const FreePlaces found = find(closed_building(), one_room_volume(), {.most_draws = 100});
    ASSERT_EQ(found.places.size(), 1000u);
    EXPECT_GT(found.drawn_count, 1000u);  // the box of places is larger than the room
    for (const FreePlace& place : found.places) {
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(place.position[axis], 0.05f);
            EXPECT_LE(place.position[axis], 1.95f);
        }
    }
}

TEST(FreePlaces, AreNotInsideGeometry) {
    Scene scene = closed_building();
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {0.5f, 0.5f, 0.5f},
                  {1.5f, 1.5f, 1.5f});
    const FreePlaces found = find(scene, one_room_volume(), {.most_draws = 100});
    ASSERT_EQ(found.places.size(), 1000u);
    for (const FreePlace& place : found.places) {
        const glm::vec3 from_center = glm::abs(place.position - 1.0f);
        EXPECT_GT(std::max({from_center.x, from_center.y, from_center.z}), 0.5f);
    }
}

TEST(FreePlaces, KeepTheirClearance) {
    const FreePlaces found =
        find(closed_building(), one_room_volume(), {.clearance = 0.6f, .most_draws = 200});
    ASSERT_EQ(found.places.size(), 1000u);
    for (const FreePlace& place : found.places) {
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(place.position[axis], 0.6f);
            EXPECT_LE(place.position[axis], 1.4f);
        }
    }
    EXPECT_TRUE(find(closed_building(), one_room_volume(), {.clearance = 1.1f}).places.empty());
}

TEST(FreePlaces, KnowWhichCornersSeeThem) {
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.5, positions);
    test::add_probes_of_room(1, 2, 0.5, positions);
    const ProbeVolume volume = test::make_lit_volume(positions);
    const FreePlaces found = find(test::row_of_rooms({1.0f, 0.0f}), volume);
    int hidden_count = 0;
    for (const FreePlace& place : found.places) {
        const Cell& cell = volume.cells[place.location.cell];
        for (int i = 0; i < 4; ++i) {
            if (!(place.location.weights[i] > 0.0f)) continue;
            const bool is_left = volume.exact_positions[cell.vertices[size_t(i)]].x < 2.1;
            const bool is_same_room = is_left == (place.position.x < 2.1f);
            EXPECT_EQ(place.is_seen[size_t(i)], is_same_room);
            hidden_count += !is_same_room;
        }
        EXPECT_FALSE(place.is_unseen());
    }
    EXPECT_GT(hidden_count, 0);
}

TEST(FreePlaces, OfPlanesLinesAndPointsAreInSightOfAProbe) {
    const Scene scene = closed_building();
    for (const std::vector<glm::dvec3>& positions :
         {std::vector<glm::dvec3>{{1, 1, 1}},
          {{0.5, 1, 1}, {1.5, 1, 1}},
          {{0.1, 1, 0.1}, {1.9, 1, 0.1}, {0.1, 1, 1.9}}}) {
        const FreePlaces found = find(scene, test::make_lit_volume(positions), {.count = 100});
        EXPECT_EQ(found.places.size(), 100u);
        for (const FreePlace& place : found.places) {
            EXPECT_GT(std::min({place.position.x, place.position.y, place.position.z}), 0.0f);
            EXPECT_LT(std::max({place.position.x, place.position.y, place.position.z}), 2.0f);
        }
    }
    EXPECT_TRUE(find(scene, test::make_lit_volume({})).places.empty());
}

TEST(FreePlaces, SeeFromWhereProbesSampleTheirLight) {
    ProbeVolume volume = test::make_lit_volume({{1.5, 1, 1}});
    volume.health.resize(1);
    volume.health[0].virtual_offset = {1.2f, 0, 0};  // into the next room
    const FreePlaces found = find(test::row_of_rooms({1.0f, 1.0f}), volume, {.count = 50});
    EXPECT_FALSE(found.places.empty());
    for (const FreePlace& place : found.places) EXPECT_GT(place.position.x, 2.2f);
}

TEST(FreePlaces, AreTheSameForAnyNumberOfThreads) {
    const ProbeVolume volume = one_room_volume();
    const auto one = find(closed_building(), volume, {.seed = 3, .thread_count = 1});
    const auto three = find(closed_building(), volume, {.seed = 3, .thread_count = 3});
    EXPECT_EQ(one.places, three.places);
    EXPECT_EQ(one.drawn_count, three.drawn_count);
    EXPECT_NE(one.places, find(closed_building(), volume, {.seed = 4}).places);
}

}  // namespace
}  // namespace tetralight
