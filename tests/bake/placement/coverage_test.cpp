// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/coverage.h>

#include <gtest/gtest.h>

#include <tetralight/bake/placement/cover_places.h>
#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

/// Probes at the corners of a cube of 2 m.
std::vector<glm::dvec3> cube() {
    std::vector<glm::dvec3> probes;
    for (int i = 0; i < 8; ++i) {
        probes.emplace_back(i % 2 * 2 - 1, i / 2 % 2 * 2 - 1, i / 4 * 2 - 1);
    }
    return probes;
}

/// A wall without thickness across the cube.
Scene wall_at(float x) {
    Scene scene;
    test::add_quad(scene, test::two_sided(), {x, -9, -9}, {0, 18, 0}, {0, 0, 18});
    return scene;
}

Cover cover_in(const Scene& scene, const glm::dvec3& place) {
    const auto traced = TraceScene::make_static(scene);
    return cover_by(*traced, cube(), std::span(&place, 1), 1).front();
}

TEST(Coverage, InTheOpenPlacesInsideTheTetrahedraAreCovered) {
    EXPECT_EQ(cover_in(Scene{}, {0.1, 0.2, 0.3}), Cover::Covered);
    EXPECT_EQ(cover_in(Scene{}, {-0.99, 0.99, -0.99}), Cover::Covered);
    EXPECT_EQ(cover_in(Scene{}, {1.01, 0.2, 0.3}), Cover::HullCell);
    EXPECT_EQ(cover_in(Scene{}, {5, 6, 7}), Cover::HullCell);
}

TEST(Coverage, PlacesOnTheHullAreBetweenProbes) {
    EXPECT_EQ(cover_in(Scene{}, {1.0, 0.2, 0.3}), Cover::Covered);
    EXPECT_EQ(cover_in(Scene{}, {-1.0, 1.0, 0.3}), Cover::Covered);
}

TEST(Coverage, AWallHidesPlacesFromCornersWithMostOfTheWeight) {
    // All corners are at x = ±1: those at 1 have the weight (1 + x) / 2 together in every cell. It
    // is a quarter at x = -0.5.
    const Scene scene = wall_at(-0.7f);
    for (const double y : {-0.9, -0.2, 0.5}) {
        EXPECT_EQ(cover_in(scene, {-0.55, y, 0.3}), Cover::Unseen);
        EXPECT_EQ(cover_in(scene, {-0.45, y, 0.3}), Cover::Covered);
        EXPECT_EQ(cover_in(scene, {-0.75, y, 0.3}), Cover::Covered);  // on the other side: 0.875
    }
}

TEST(Coverage, BehindAWallAroundAllProbesNothingIsSeen) {
    Scene scene;
    test::add_box(scene, test::two_sided(), test::Facing::Outward, {-0.5f, -0.5f, -0.5f},
                  {0.5f, 0.5f, 0.5f});
    EXPECT_EQ(cover_in(scene, {0.1, 0.2, 0.3}), Cover::Unseen);
}

TEST(Coverage, WithoutProbesAllPlacesAreInHullCells) {
    const auto traced = TraceScene::make_static(Scene{});
    const std::vector<glm::dvec3> places{{0, 0, 0}, {1, 2, 3}};
    EXPECT_EQ(cover_by(*traced, {}, places, 1), std::vector<Cover>(2, Cover::HullCell));
}

TEST(Coverage, WithoutTetrahedraPlacesOffTheProbesAreUncovered) {
    const auto traced = TraceScene::make_static(Scene{});
    const std::vector<glm::dvec3> plane{{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1}};
    const std::vector<glm::dvec3> places{{0.1, 0, 0.2}, {0.1, 0.5, 0.2}, {3, 0, 0.2}};
    using enum Cover;
    EXPECT_EQ(cover_by(*traced, plane, places, 1),
              (std::vector<Cover>{Covered, HullCell, HullCell}));
    EXPECT_EQ(cover_by(*traced, std::span(places).first(1), places, 1),
              (std::vector<Cover>{Covered, HullCell, HullCell}));
}

TEST(Coverage, SharesAreOfAllPlaces) {
    using enum Cover;
    const std::vector<Cover> covers{Covered, Unseen,  Covered, HullCell,
                                    Covered, Covered, Unseen,  Covered};
    const Coverage coverage = count_cover(covers);
    EXPECT_EQ(coverage.place_count(), 8u);
    EXPECT_EQ(coverage.count(Unseen), 2u);
    EXPECT_EQ(coverage.share(Covered), 5.0 / 8.0);
    EXPECT_EQ(coverage.share(HullCell), 1.0 / 8.0);
    EXPECT_EQ(Coverage{}.share(Covered), 0.0);
}

}  // namespace
}  // namespace tetralight
