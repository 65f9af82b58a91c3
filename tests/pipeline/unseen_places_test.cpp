// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/unseen_places.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"
#include "tests/support/rooms.h"

namespace tetralight {
namespace {

/// Places on a line, of which those with an x of 10 or more are unseen.
FreePlaces on_a_line(int count, float step) {
    FreePlaces found;
    found.spacing = 1.0f;
    for (int i = 0; i < count; ++i) {
        FreePlace place;
        place.position.x = step * static_cast<float>(i);
        place.is_seen[2] = place.position.x < 10.0f;
        found.places.push_back(place);
    }
    return found;
}

/// Three equal rooms in a row, of which the middle one has no probe.
std::vector<glm::dvec3> outer_rooms() {
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 3, 0.05, positions);
    test::add_probes_of_room(2, 3, 0.05, positions);
    return positions;
}

TEST(UnseenPlaces, AreCounted) {
    const UnseenPlaces unseen = find_unseen(on_a_line(40, 0.5f));
    EXPECT_EQ(unseen.place_count, 40u);
    EXPECT_EQ(unseen.unseen_count, 20u);
    EXPECT_EQ(unseen.share(), 0.5);
    EXPECT_EQ(find_unseen({}), UnseenPlaces{});
    EXPECT_EQ(UnseenPlaces{}.share(), 0.0);
}

TEST(UnseenPlaces, AreShownFromTheMiddleOutwards) {
    const auto unseen = find_unseen(on_a_line(101, 1.0f));  // from 10 to 100
    ASSERT_EQ(unseen.positions.size(), 8u);
    EXPECT_EQ(unseen.positions[0].x, 55.0);
    EXPECT_EQ(unseen.positions[1].x, 10.0);
    EXPECT_EQ(unseen.positions[2].x, 100.0);
}

TEST(UnseenPlaces, NearerThanTheSpacingAreShownOnce) {
    EXPECT_EQ(find_unseen(on_a_line(106, 0.1f)).positions.size(), 1u);  // from 10 to 10.5
}

TEST(UnseenPlaces, AreTheShareOfSpaceOfARoomWithoutProbes) {
    const Scene scene = test::row_of_rooms({1.0f, 1.0f, 1.0f});
    const ProbeVolume volume = test::make_lit_volume(outer_rooms());
    const auto unseen = measure_unseen(scene, volume.view(), 0.75f);
    ASSERT_TRUE(unseen);
    ASSERT_EQ(unseen->place_count, kUnseenPlaceCount);
    // All of each room from 5 cm off its walls lies between probes.
    const double deviation = std::sqrt(1.0 / 3.0 * 2.0 / 3.0 / kUnseenPlaceCount);
    EXPECT_NEAR(unseen->share(), 1.0 / 3.0, 4.0 * deviation);
    ASSERT_FALSE(unseen->positions.empty());
    for (const glm::dvec3& position : unseen->positions) {
        EXPECT_GT(position.x, 2.2);
        EXPECT_LT(position.x, 4.2);
    }
}

TEST(UnseenPlaces, AreNoneWithoutWalls) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f, -1.0f);
    const auto unseen =
        measure_unseen(scene, test::make_lit_volume(test::random_positions(60, 1)).view(), 0.75f);
    ASSERT_TRUE(unseen);
    EXPECT_EQ(unseen->place_count, kUnseenPlaceCount);
    EXPECT_EQ(unseen->unseen_count, 0u);
}

TEST(UnseenPlaces, AreInTheReportOfABakeAndInItsVolume) {
    const Scene scene = test::row_of_rooms({1.0f, 1.0f, 1.0f});
    const std::vector<ProbeGroup> groups{test::make_group("rooms", outer_rooms())};
    BakeVolumeSettings settings;
    settings.bake.sample_count = 16;
    settings.bake.thread_count = 1;
    const auto one = bake_volume(scene, groups, settings);
    settings.bake.thread_count = 3;
    const auto three = bake_volume(scene, groups, settings);
    ASSERT_TRUE(one && three);
    EXPECT_EQ(one->report.unseen, *measure_unseen(scene, one->volume.view(), 0.75f));
    EXPECT_GT(one->report.unseen.unseen_count, 0u);
    EXPECT_EQ(one->volume, three->volume);
}

}  // namespace
}  // namespace tetralight
