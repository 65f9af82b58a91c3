// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/hilbert.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace tetralight {
namespace {

TEST(Hilbert, NeighborsOnTheCurveAreNeighborsInSpace) {
    // The coarsest 8³ blocks of the curve: consecutive ones share a face.
    constexpr uint32_t kBlock = 1u << 18;
    std::map<uint64_t, std::array<uint32_t, 3>> blocks;
    for (uint32_t x = 0; x < 8; ++x) {
        for (uint32_t y = 0; y < 8; ++y) {
            for (uint32_t z = 0; z < 8; ++z) {
                blocks[hilbert_index({x * kBlock, y * kBlock, z * kBlock}) >> 54] = {x, y, z};
            }
        }
    }
    ASSERT_EQ(blocks.size(), 512u);
    for (uint64_t i = 1; i < 512; ++i) {
        uint32_t steps = 0;
        for (int axis = 0; axis < 3; ++axis) {
            steps += static_cast<uint32_t>(std::abs(static_cast<int>(blocks[i][axis]) -
                                                    static_cast<int>(blocks[i - 1][axis])));
        }
        EXPECT_EQ(steps, 1u) << i;
    }
}

/// Skilling 2004, "Programming the Hilbert curve", AxestoTranspose, and the bits of the result.
uint64_t skilling_index(std::array<uint32_t, 3> x) {
    for (uint32_t bit = 1u << (kHilbertBits - 1); bit > 1; bit >>= 1) {
        for (uint32_t& axis : x) {
            const uint32_t swap = axis & bit ? 0u : (x[0] ^ axis) & (bit - 1);
            x[0] ^= axis & bit ? bit - 1 : swap;
            axis ^= swap;
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    uint32_t gray = 0;
    for (uint32_t bit = 1u << (kHilbertBits - 1); bit > 1; bit >>= 1) {
        if (x[2] & bit) gray ^= bit - 1;
    }
    uint64_t index = 0;
    for (int bit = kHilbertBits - 1; bit >= 0; --bit) {
        for (const uint32_t axis : x) index = index << 1 | ((axis ^ gray) >> bit & 1u);
    }
    return index;
}

TEST(Hilbert, IsSkillingsCurve) {
    std::mt19937 engine(1);
    for (int i = 0; i < 10'000; ++i) {
        std::array<uint32_t, 3> point;
        for (uint32_t& axis : point) axis = static_cast<uint32_t>(engine()) >> (32 - kHilbertBits);
        ASSERT_EQ(hilbert_index(point), skilling_index(point));
    }
}

TEST(Hilbert, CubeKeepsItsCornersAndMovesOutsidersToItsSide) {
    const HilbertCube cube = make_hilbert_cube({1, 1, 1}, {3, 2, 2});
    EXPECT_EQ(cube.index({1, 1, 1}), hilbert_index({0, 0, 0}));
    constexpr uint32_t kLast = (1u << kHilbertBits) - 1;
    EXPECT_EQ(cube.index({3, 3, 3}), hilbert_index({kLast, kLast, kLast}));
    EXPECT_EQ(cube.index({9, 0, 9}), hilbert_index({kLast, 0, kLast}));
}

TEST(Hilbert, ACubeWithoutSizeIsOnePoint) {
    const HilbertCube cube = make_hilbert_cube({5, 5, 5}, {5, 5, 5});
    EXPECT_EQ(cube.index({5, 5, 5}), cube.index({1, 2, 3}));
}

}  // namespace
}  // namespace tetralight
