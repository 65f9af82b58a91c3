// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/free_space_map.h>

#include <gtest/gtest.h>

#include <span>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;

/// Bounds of all maps. The points of theirs are at multiples of 25 cm.
const WorldBox kFour{{-2, -2, -2}, {2, 2, 2}};

/// An opening in the plane z = `z`.
struct Opening {
    glm::vec2 low, high;
    float z = 0.0f;

    glm::vec2 center() const { return 0.5f * (low + high); }
};

/// A sheet with an opening, which is longer and wider than the bounds.
Scene sheet_with(const Opening& opening) {
    constexpr float kFar = 9.0f;
    const auto [low, high, z] = opening;
    Scene scene;
    const auto add = [&](glm::vec2 from, glm::vec2 to) {
        test::add_quad(scene, test::two_sided(), {from.x, from.y, z}, {to.x - from.x, 0, 0},
                       {0, to.y - from.y, 0});
    };
    add({-kFar, -kFar}, {low.x, kFar});
    add({high.x, -kFar}, {kFar, kFar});
    add({low.x, -kFar}, {high.x, low.y});
    add({low.x, high.y}, {high.x, kFar});
    return scene;
}

/// True if both sides of the plane z = 0 are one space for a body of this radius.
bool joins(const Scene& scene, double radius, std::span<const glm::dvec3> probes = {}) {
    const auto traced = TraceScene::make_static(scene);
    FreeSpaceMap map(*traced, {kFour, glm::dvec3(1.0), radius, 0});
    map.join(probes);
    const uint32_t front = map.space_of({1.1, 1.2, 1.3}), back = map.space_of({1.1, 1.2, -1.3});
    EXPECT_NE(front, kNoIndex);
    EXPECT_NE(back, kNoIndex);
    return front == back;
}

TEST(FreeSpaceMap, ASheetParts) {
    EXPECT_FALSE(joins(sheet_with({}), 0.0));
    EXPECT_FALSE(joins(sheet_with({}), 0.1));
    EXPECT_TRUE(joins(Scene{}, 0.25));
}

TEST(FreeSpaceMap, ACrackOfAMillimetreLetsNoBodyThrough) {
    // A line between two points passes through it: a point passes, too.
    const Scene scene = sheet_with({{-0.0005f, -9}, {0.0005f, 9}, 0.1f});
    EXPECT_TRUE(joins(scene, 0.0));
    EXPECT_FALSE(joins(scene, 0.01));
    EXPECT_FALSE(joins(scene, 0.1));
}

TEST(FreeSpaceMap, ADoorOf80CentimetresJoins) {
    for (const float left : {-0.4f, -0.33f, -0.27f, -0.2f}) {
        const Scene scene = sheet_with({{left, -9}, {left + 0.8f, 0.07f}, 0.11f});
        EXPECT_TRUE(joins(scene, 0.1)) << left;
        EXPECT_TRUE(joins(scene, 0.25)) << left;
        EXPECT_TRUE(joins(scene, 0.3)) << left;
        EXPECT_FALSE(joins(scene, 0.41)) << left;
    }
}

TEST(FreeSpaceMap, BarsBeforeAWindowPart) {
    Scene scene = sheet_with({{-0.5f, -0.5f}, {0.5f, 0.5f}});
    EXPECT_TRUE(joins(scene, 0.1));
    for (float x = -0.48f; x < 0.5f; x += 0.12f) {  // 7 cm apart
        add_box(scene, test::grey(), Facing::Outward, {x, -0.6f, -0.025f},
                {x + 0.05f, 0.6f, 0.025f});
    }
    EXPECT_FALSE(joins(scene, 0.1));
    EXPECT_FALSE(joins(scene, 0.04));
}

TEST(FreeSpaceMap, AHoleAsWideAsTheBodyJoins) {
    const auto hole = [](float size) {
        return sheet_with({{0.1f, 0.1f}, {0.1f + size, 0.1f + size}, 0.03f});
    };
    EXPECT_TRUE(joins(hole(1.0f), 0.1));
    EXPECT_TRUE(joins(hole(1.0f), 0.25));
    EXPECT_FALSE(joins(hole(0.1f), 0.1));
    EXPECT_FALSE(joins(hole(0.19f), 0.1));
}

TEST(FreeSpaceMap, NoBodyIsBetweenTwoFloors10CentimetresApart) {
    Scene scene = sheet_with({});
    test::add_quad(scene, test::two_sided(), {-9, -9, 0.1f}, {18, 0, 0}, {0, 18, 0});
    const auto traced = TraceScene::make_static(scene);
    FreeSpaceMap map(*traced, {kFour, glm::dvec3(1.0), 0.1, 0});
    EXPECT_EQ(map.space_of({0.3, 0.4, 0.05}), kNoIndex);
    EXPECT_EQ(map.points_by_space(kFour).size(), 2u);
    EXPECT_FALSE(joins(scene, 0.1));
}

TEST(FreeSpaceMap, PointsOnASurfaceDoNotJoinItsSides) {
    EXPECT_FALSE(joins(sheet_with({{0, 0}, {0, 0}, 0.25f}), 0.0));
}

TEST(FreeSpaceMap, AProbeInAnOpeningJoinsItsSides) {
    // 20 cm wide. No line between two points passes through it: halfway between two layers, lines
    // cross it at multiples of 12.5 cm.
    const Scene scene = sheet_with({{-0.0375f, -0.0375f}, {0.1625f, 0.1625f}, 0.125f});
    EXPECT_FALSE(joins(scene, 0.05));
    const glm::dvec3 probe(0.0625, 0.0625, 0.125);
    EXPECT_TRUE(joins(scene, 0.05, std::span(&probe, 1)));
    EXPECT_FALSE(joins(scene, 0.11, std::span(&probe, 1)));  // it does not fit there
}

TEST(FreeSpaceMap, ASkyboxChangesNothing) {
    Scene scene = sheet_with({});
    const auto points = [&] {
        const auto traced = TraceScene::make_static(scene);
        return FreeSpaceMap(*traced, {kFour, glm::dvec3(1.0), 0.1, 0}).points_by_space(kFour);
    };
    const auto before = points();
    add_box(scene, test::grey(), Facing::Inward, glm::vec3(-1000), glm::vec3(1000));
    EXPECT_EQ(points(), before);
}

TEST(FreeSpaceMap, PointsFillTheVolumeOfTheirSpace) {
    const auto traced = TraceScene::make_static(Scene{});
    const FreeSpaceMap map(*traced, {kFour, glm::dvec3(1.0), 0.1, 0});
    const auto points = map.points_by_space({{-1.01, -1.01, -1.01}, {0.99, 0.99, 0.99}});
    ASSERT_EQ(points.size(), 1u);
    const auto count = static_cast<double>(points.begin()->second.size());
    EXPECT_DOUBLE_EQ(count * map.point_volume(), 8.0);
}

}  // namespace
}  // namespace tetralight
