// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/lppv/sparse_lppv.h>

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <thread>

#include "tests/lppv/lppv_fixture.h"

namespace tetralight {
namespace {

/// Blocks in a form that can be looked up.
std::set<std::tuple<int, int, int>> set_of(const SparseBlocks& blocks) {
    std::set<std::tuple<int, int, int>> result;
    for (const glm::ivec3& block : blocks.sorted()) result.insert({block.x, block.y, block.z});
    return result;
}

TEST(SparseBlocks, EveryPositionOfABoxLiesBetweenPoints) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> coordinate(-20.0, 20.0), size(0.0, 9.0);
    for (int round = 0; round < 50; ++round) {
        SparseBlocks blocks(0.3);
        const glm::dvec3 low(coordinate(engine), coordinate(engine), coordinate(engine));
        const glm::dvec3 extent(size(engine), size(engine), size(engine));
        ASSERT_TRUE(blocks.add_box(low, low + extent));
        const auto set = set_of(blocks);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 share = glm::dvec3(size(engine), size(engine), size(engine)) / 9.0;
            const glm::dvec3 cell = glm::floor((low + share * extent) / 0.3);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 point =
                    cell + glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2);
                const glm::ivec3 block(glm::floor(point / 8.0));
                ASSERT_TRUE(set.contains({block.x, block.y, block.z}));
            }
        }
    }
}

TEST(SparseBlocks, APointNeedsOneBlockAndOnABorderTwo) {
    SparseBlocks blocks(1.0);
    ASSERT_TRUE(blocks.add_box({3.5, 3.5, 3.5}, {3.5, 3.5, 3.5}));
    EXPECT_EQ(blocks.sorted(), std::vector<glm::ivec3>{glm::ivec3(0)});
    ASSERT_TRUE(blocks.add_box({7.5, 3.5, 3.5}, {7.5, 3.5, 3.5}));
    EXPECT_EQ(blocks.sorted(), (std::vector<glm::ivec3>{{0, 0, 0}, {1, 0, 0}}));
}

TEST(SparseBlocks, RefusesTooManyPointsAndSaysHowMany) {
    SparseBlocks blocks(0.001);
    const auto status = blocks.add_box(glm::dvec3(-1.0), glm::dvec3(1.0));
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              "a sparse grid of 8096384512 points or more is too large: the limit is 16777216");
    EXPECT_FALSE(blocks.add_box(glm::dvec3(std::numeric_limits<double>::quiet_NaN()), {}));
    EXPECT_FALSE(blocks.add_box(glm::dvec3(1e9), glm::dvec3(1e9)));
    EXPECT_FALSE(blocks.add_box(glm::dvec3(1.0), glm::dvec3(0.0)));
}

TEST(SparseLppv, HoldsTheLightOfEachPoint) {
    const ProbeVolume volume = test::make_cube_volume();
    SparseBlocks blocks(0.2);
    ASSERT_TRUE(blocks.add_box(glm::dvec3(-1.2), glm::dvec3(1.2)));
    const auto serial = [](size_t count, auto&& task) {
        for (size_t i = 0; i < count; ++i) task(i);
    };
    const auto threads = [](size_t count, auto&& task) {
        std::vector<std::jthread> workers;
        for (size_t i = count; i-- > 0;) workers.emplace_back([&task, i] { task(i); });
    };
    const SparseLppv lppv = make_sparse_lppv(volume.view(), blocks, serial);
    EXPECT_EQ(lppv, make_sparse_lppv(volume.view(), blocks, threads));
    ASSERT_EQ(lppv.blocks.size(), 8u);
    for (size_t i = 0; i < lppv.irradiance.size(); ++i) {
        const glm::ivec3 inside(i % 8, i / 8 % 8, i / 64 % 8);
        const glm::dvec3 p = 0.2 * glm::dvec3(8 * lppv.blocks[i / 512] + inside);
        for (int k = 0; k < kShCoefficientCount; ++k) {
            ASSERT_LE(glm::distance(lppv.irradiance[i].coefficients[k],
                                    test::linear_light(p).coefficients[k]),
                      1e-4f);
        }
    }
}

TEST(SparseLppv, PointsTakeTheLightThatTheObjectReceives) {
    const ProbeVolume volume = test::make_walled_volume();
    SparseBlocks blocks(0.2);
    ASSERT_TRUE(blocks.add_box(glm::dvec3(-0.5), glm::dvec3(0.5)));
    const auto serial = [](size_t count, auto&& task) {
        for (size_t i = 0; i < count; ++i) task(i);
    };
    for (const Receiver& receiver : {Receiver{}, Receiver{.rendering_layers = 0b01},
                                     Receiver{.radius = 0.5f}, Receiver{Walls::Ignore}}) {
        const SparseLppv lppv = make_sparse_lppv(volume.view(), blocks, serial, receiver);
        for (size_t i = 0; i < lppv.irradiance.size(); i += 3) {
            const glm::ivec3 inside(i % 8, i / 8 % 8, i / 64 % 8);
            const glm::vec3 p(0.2 * glm::dvec3(8 * lppv.blocks[i / 512] + inside));
            const IrradianceSh expected =
                interpolate(volume.view(), locate(volume.view(), p), receiver).irradiance;
            for (int k = 0; k < kShCoefficientCount; ++k) {
                ASSERT_LE(
                    glm::distance(lppv.irradiance[i].coefficients[k], expected.coefficients[k]),
                    1e-4f);
            }
        }
    }
}

}  // namespace
}  // namespace tetralight
