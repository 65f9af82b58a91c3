// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lppv_coverage.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/pipeline/lppv_validity.h>
#include "tests/support/random_probes.h"
#include "tests/support/rooms.h"

namespace tetralight {
namespace {

LppvGrid make_grid(const glm::dvec3& min, const glm::dvec3& max, glm::uvec3 resolution,
                   LppvPlacement placement = LppvPlacement::CellCenters) {
    const LppvPart box{glm::dmat4(1.0), min, max};
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = resolution;
    settings.placement = placement;
    return *make_lppv_grid({glm::dmat4(1.0), std::span(&box, 1)}, settings);
}

/// The corners of [-1, 1]³, moved.
ProbeVolume make_cube(const glm::dvec3& center = glm::dvec3(0.0)) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 8; ++i) {
        positions.push_back(center + 2.0 * glm::dvec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - 1.0);
    }
    return test::make_lit_volume(positions);
}

LppvCoverage find_in(const Scene& scene, const ProbeVolume& volume, const LppvGrid& grid,
                     uint32_t thread_count = 1) {
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    const auto validity = lppv_grid_validity(*traced, grid, thread_count);
    return find_lppv_coverage(volume.view(), grid, {*traced, validity}, thread_count);
}

void expect_counts(const LppvCoverage& coverage, uint64_t covered, uint64_t outside,
                   uint64_t unseen) {
    EXPECT_EQ(coverage.points.count(Cover::Covered), covered);
    EXPECT_EQ(coverage.points.count(Cover::HullCell), outside);
    EXPECT_EQ(coverage.points.count(Cover::Unseen), unseen);
}

TEST(LppvCoverage, CountsPointsOutsideOfTheTetrahedra) {
    // x = 0.1, 0.3 .. 1.9: half of them beyond the probes at x = 1.
    const LppvGrid grid = make_grid({0, -0.8, -0.8}, {2, 0.8, 0.8}, {10, 4, 4});
    const LppvCoverage coverage = find_lppv_coverage(make_cube().view(), grid);
    expect_counts(coverage, 80, 80, 0);
    ASSERT_FALSE(coverage.positions.empty());
    for (const UncoveredPoint& point : coverage.positions) {
        EXPECT_EQ(point.cover, Cover::HullCell);
        EXPECT_GT(point.position.x, 1.0);
    }
}

TEST(LppvCoverage, PlacesProbesAtTheEndsOfWhatIsOutside) {
    const LppvGrid grid = make_grid({0, -0.5, -0.5}, {40, 0.5, 0.5}, {20, 1, 1});  // x = 1, 3 .. 39
    const LppvCoverage coverage = find_lppv_coverage(make_cube().view(), grid);
    expect_counts(coverage, 1, 19, 0);
    ASSERT_EQ(coverage.positions.size(), 8u);
    EXPECT_EQ(coverage.positions[0].position, glm::dvec3(21, 0, 0));
    EXPECT_EQ(coverage.positions[1].position, glm::dvec3(3, 0, 0));
    EXPECT_EQ(coverage.positions[2].position, glm::dvec3(39, 0, 0));
}

TEST(LppvCoverage, PointsOnTheHullAreCovered) {
    const glm::dvec3 center(1000.3, -20.1, 7.7);
    const LppvGrid grid =
        make_grid(center - 1.0, center + 1.0, glm::uvec3(9, 8, 7), LppvPlacement::CellCorners);
    const LppvCoverage coverage = find_lppv_coverage(make_cube(center).view(), grid);
    expect_counts(coverage, 9 * 8 * 7, 0, 0);
    EXPECT_TRUE(coverage.positions.empty());
}

TEST(LppvCoverage, CountsPointsInARoomWithoutProbesAsUnseen) {
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 3, 0.05, positions);
    test::add_probes_of_room(2, 3, 0.05, positions);
    const ProbeVolume volume = test::make_lit_volume(positions);
    const Scene scene = test::row_of_rooms({1.0f, 1.0f, 1.0f});
    // x = 0.1 .. 1.9 in the first room, 2.1 between walls, 2.3 .. 4.1 in the second.
    const LppvGrid grid = make_grid({0, 0, 0}, {4.2, 2, 2}, {21, 4, 4});
    const LppvCoverage coverage = find_in(scene, volume, grid);
    expect_counts(coverage, 160, 0, 160);
    ASSERT_FALSE(coverage.positions.empty());
    for (const UncoveredPoint& point : coverage.positions) {
        EXPECT_EQ(point.cover, Cover::Unseen);
        EXPECT_GT(point.position.x, 2.2);
    }
    EXPECT_EQ(find_in(scene, volume, grid, 3), coverage);
}

TEST(LppvCoverage, PlacesProbesForBothKindsOfUncoveredPoints) {
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.5, positions);
    test::add_probes_of_room(2, 2, 0.5, positions);
    const Scene scene = test::row_of_rooms({1.0f, 1.0f, 1.0f});
    const LppvGrid grid = make_grid({0, 0, 0}, {6.4, 2, 2}, {32, 10, 10});
    const LppvCoverage coverage = find_in(scene, test::make_lit_volume(positions), grid);
    const auto count = [&](Cover cover) {
        return std::ranges::count(coverage.positions, cover, &UncoveredPoint::cover);
    };
    EXPECT_EQ(count(Cover::HullCell), 4);
    EXPECT_GT(count(Cover::Unseen), 0);
    EXPECT_LE(count(Cover::Unseen), 4);
}

TEST(LppvCoverage, LeavesOutTheOutsideOfABuildingAndItsWalls) {
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.5, positions);
    // x = -1 .. -0.2 before the wall, 0 on it, 0.2 and 0.4 in the room beside its probes, 0.6 .. 1
    // between them.
    const LppvGrid grid = make_grid({-1.1, 0.6, 0.6}, {1.1, 1.4, 1.4}, {11, 4, 4});
    expect_counts(find_in(test::row_of_rooms({1.0f}), test::make_lit_volume(positions), grid), 48,
                  32, 0);
}

TEST(LppvCoverage, KnowsTheVirtualOffsetOfProbes) {
    // Probes 0.1 m behind the walls of a room, whose light is that of its inside.
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, -0.1, positions);
    ProbeVolume volume = test::make_lit_volume(positions);
    const LppvGrid grid = make_grid(glm::dvec3(0.0), glm::dvec3(2.0), glm::uvec3(4));
    const Scene scene = test::row_of_rooms({1.0f});
    expect_counts(find_in(scene, volume, grid), 0, 0, 64);
    for (const glm::dvec3& position : volume.exact_positions) {
        ProbeHealth health;
        health.virtual_offset = 0.2f * (glm::vec3(1.0f) - glm::vec3(position));
        volume.health.push_back(health);
    }
    expect_counts(find_in(scene, volume, grid), 64, 0, 0);
}

TEST(LppvCoverage, NothingIsOutsideOfProbesInAPlane) {
    const ProbeVolume volume =
        test::make_lit_volume({{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1}});
    const LppvGrid grid = make_grid({-2, -1, -2}, {2, 1, 2}, {8, 2, 8});
    // 4 x 2 x 4 of the points lie above and below the square.
    expect_counts(find_lppv_coverage(volume.view(), grid), 32, 0, 0);
    expect_counts(find_lppv_coverage(ProbeVolumeView{}, grid), 0, 0, 0);
}

}  // namespace
}  // namespace tetralight
