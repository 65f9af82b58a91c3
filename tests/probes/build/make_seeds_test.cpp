// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_seeds.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/probes/locate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

TEST(MakeSeeds, EverySeedIsACellOfTheProbeItStandsFor) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(400, 1));
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
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(1000, 2));
    EXPECT_TRUE(std::ranges::is_sorted(volume.seeds, {}, &Seed::hilbert_index));
}

TEST(MakeSeeds, ServeClustersThatAreSmallInTheirBox) {
    // Two clusters of a metre, a kilometre apart: each has its own seeds.
    std::vector<glm::dvec3> positions = test::random_positions(200, 3, 0.5);
    for (size_t i = 0; i < 100; ++i) positions[i].x += 1000.0;
    const ProbeVolume volume = test::make_lit_volume(positions);
    const auto is_far = [&](const Seed& seed) {
        return volume.positions[volume.cells[seed.cell].vertices[0]].x > 500.0f;
    };
    EXPECT_GE(std::ranges::count_if(volume.seeds, is_far), 8);
}

TEST(MakeSeeds, OfNothingAreNone) {
    EXPECT_TRUE(make_seeds({}, {}).seeds.empty());
}

}  // namespace
}  // namespace tetralight
