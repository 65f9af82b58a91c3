// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_seed_grid.h>

#include <gtest/gtest.h>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/seed_grid.h>
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

double mean_steps(const ProbeVolume& volume, const std::vector<glm::dvec3>& positions) {
    double sum = 0.0;
    for (const glm::dvec3& p : positions) {
        sum += trace_location(volume.view(), glm::vec3(p)).step_count;
    }
    return sum / static_cast<double>(positions.size());
}

TEST(MakeSeedGrid, WalksTakeTwoStepsInsideTheHullAndOutside) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(5000, 1));
    EXPECT_LT(mean_steps(volume, test::random_positions(5000, 2, 0.9)), 2.5);
    EXPECT_LT(mean_steps(volume, test::random_positions(5000, 3, 1.2)), 2.5);
}

TEST(MakeSeedGrid, HasFinerGridsWhereProbesAreDense) {
    // Two clusters of 10 cm, a kilometre apart.
    const auto cluster = test::random_positions(2000, 4, 0.05);
    const glm::dvec3 far(1000, 300, -200);
    const ProbeVolume volume = test::make_lit_volume(test::joined(
        cluster, test::moved(test::random_positions(2000, 5, 0.05), glm::dvec3(1), far)));
    EXPECT_LT(mean_steps(volume, test::random_positions(2000, 6, 0.05)), 4.0);
    EXPECT_LT(
        mean_steps(volume, test::moved(test::random_positions(2000, 7, 0.05), glm::dvec3(1), far)),
        4.0);
}

TEST(MakeSeedGrid, WalksBesideAClusterBeginAtIt) {
    // The cluster ends at the border of its voxel: that of the box of all probes.
    const glm::dvec3 far(1000, 300, -200);
    const ProbeVolume volume = test::make_lit_volume(
        test::joined(test::random_positions(2000, 4, 0.05),
                     test::moved(test::random_positions(2000, 5, 0.05), glm::dvec3(1), far)));
    EXPECT_LT(mean_steps(volume, test::random_positions(2000, 6, 0.06)), 4.0);
    EXPECT_LT(
        mean_steps(volume, test::moved(test::random_positions(2000, 7, 0.06), glm::dvec3(1), far)),
        4.0);
}

TEST(MakeSeedGrid, TakesSevenWordsAProbeAtMost) {
    for (const test::ProbeFamily& family : test::probe_families()) {
        const ProbeVolume volume = test::make_lit_volume(family.make(1));
        EXPECT_LE(volume.seed_grid.size(), 7 * volume.positions.size() + 64) << family.name;
    }
}

TEST(MakeSeedGrid, NamesTheCellAtTheCenterOfAVoxel) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(300, 8));
    const SeedGridHeader grid = seed_grid_header(volume.seed_grid, 0);
    for (uint32_t x = 0; x < grid.size[0]; ++x) {
        glm::vec3 center;
        const std::array<uint32_t, 3> voxel{x, grid.size[1] / 2, grid.size[2] / 2};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<size_t>(axis);
            center[axis] = grid.min[a] + (static_cast<float>(voxel[a]) + 0.5f) / grid.scale[a];
        }
        EXPECT_LE(trace_location(volume.view(), center).step_count, 2u);
    }
}

TEST(MakeSeedGrid, OfNoProbesIsEmpty) {
    EXPECT_TRUE(make_seed_grid({}).empty());
}

}  // namespace
}  // namespace tetralight
