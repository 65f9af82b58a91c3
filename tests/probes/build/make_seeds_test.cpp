// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_seeds.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/probes/locate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

ProbeVolume make_volume_with_seeds(const std::vector<glm::dvec3>& positions) {
    ProbeVolume volume = test::make_lit_volume(positions);
    volume.seed_grid.clear();
    make_seeds(volume);
    return volume;
}

TEST(MakeSeeds, AVolumeWithASeedGridHasNone) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(400, 1));
    EXPECT_FALSE(volume.seed_grid.empty());
    EXPECT_TRUE(volume.seeds.empty());
}

TEST(MakeSeeds, WithoutASeedGridWalksStartAtThem) {
    ProbeVolume volume = make_volume_with_seeds(test::random_positions(5000, 4));
    const auto mean_steps = [&] {
        double sum = 0.0;
        for (const glm::vec3& p : volume.positions) {
            sum +=
                trace_location(volume.view(), p + glm::vec3(volume.info.world_origin)).step_count;
        }
        return sum / static_cast<double>(volume.positions.size());
    };
    const double from_seeds = mean_steps();
    volume.seeds.clear();  // from the first cell
    EXPECT_LT(3.0 * from_seeds, mean_steps());
}

TEST(MakeSeeds, EverySeedIsACellOfTheProbeItStandsFor) {
    const ProbeVolume volume = make_volume_with_seeds(test::random_positions(400, 1));
    ASSERT_EQ(volume.seeds.size(), 50u);
    for (const Seed& seed : volume.seeds) {
        ASSERT_LT(seed.cell, volume.info.inner_cell_count);
        const auto& vertices = volume.cells[seed.cell].vertices;
        EXPECT_TRUE(std::ranges::any_of(vertices, [&](uint32_t probe) {
            const glm::dvec3 position(volume.positions[probe]);
            return volume.info.seed_cube.index(position) == seed.hilbert_index;
        }));
    }
}

TEST(MakeSeeds, AreSorted) {
    const ProbeVolume volume = make_volume_with_seeds(test::random_positions(1000, 2));
    EXPECT_TRUE(std::ranges::is_sorted(volume.seeds, {}, &Seed::hilbert_index));
}

TEST(MakeSeeds, ServeClustersThatAreSmallInTheirBox) {
    // Two clusters of a metre, a kilometre apart: each has its own seeds.
    std::vector<glm::dvec3> positions = test::random_positions(200, 3, 0.5);
    for (size_t i = 0; i < 100; ++i) positions[i].x += 1000.0;
    const ProbeVolume volume = make_volume_with_seeds(positions);
    const auto is_far = [&](const Seed& seed) {
        return volume.positions[volume.cells[seed.cell].vertices[0]].x > 500.0f;
    };
    EXPECT_GE(std::ranges::count_if(volume.seeds, is_far), 8);
}

TEST(MakeSeeds, OfNothingAreNone) {
    ProbeVolume volume;
    make_seeds(volume);
    EXPECT_TRUE(volume.seeds.empty());
}

}  // namespace
}  // namespace tetralight
