// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/sparse_blocks.h>

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

std::set<std::tuple<int, int, int>> set_of(const SparseBlocks& blocks) {
    std::set<std::tuple<int, int, int>> result;
    for (const glm::ivec3& block : blocks.sorted()) result.insert({block.x, block.y, block.z});
    return result;
}

/// Whether the cell around a position has its points.
bool holds(const std::set<std::tuple<int, int, int>>& blocks, double spacing,
           const glm::dvec3& position) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point =
            glm::floor(position / spacing) + glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::ivec3 block(glm::floor(point / 8.0));
        if (!blocks.contains({block.x, block.y, block.z})) return false;
    }
    return true;
}

TEST(SparseBlocks, HoldEveryPlaceNearASurfaceAndLittleElse) {
    Scene scene;
    // A slanted rhomb of 500 m: its box has 187 000 blocks, its surface touches 3 600 faces of
    // them.
    test::add_quad(scene, {}, {0, 0, 0}, {400, 300, 0}, {0, 300, 400});
    SparseBlocks blocks(1.0);
    ASSERT_TRUE(add_blocks_near_surfaces(scene, 0.5, blocks));
    const auto set = set_of(blocks);
    EXPECT_LT(set.size(), 25'000u);
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> share(0.0, 1.0), offset(-0.5, 0.5);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 on =
            share(engine) * glm::dvec3(400, 300, 0) + share(engine) * glm::dvec3(0, 300, 400);
        const glm::dvec3 near = on + glm::dvec3(offset(engine), offset(engine), offset(engine));
        ASSERT_TRUE(holds(set, 1.0, near));
    }
}

TEST(SparseBlocks, HoldEveryPlaceNearAProbe) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1, 2000.0));
    SparseBlocks blocks(1.0);
    ASSERT_TRUE(add_blocks_near_probes(volume.view(), 3.0, blocks));
    const auto set = set_of(blocks);
    EXPECT_LE(set.size(), 50u * 8u);
    for (const glm::dvec3& p : volume.exact_positions) {
        EXPECT_TRUE(holds(set, 1.0, p + glm::dvec3(2.9, -2.9, 0.0)));
    }
}

}  // namespace
}  // namespace tetralight
