// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/lattice.h>

#include <gtest/gtest.h>

#include <glm/matrix.hpp>
#include <vector>

namespace tetralight::detail {
namespace {

/// The lattice through the origin and some positions.
Lattice through(const std::vector<glm::dvec3>& positions) {
    Lattice lattice;
    for (const glm::dvec3& p : positions) {
        while (!is_near_place(lattice, p)) {
            if (!extend(lattice, p)) return {};
        }
    }
    return lattice;
}

TEST(Lattice, GetsADimensionForEachIndependentPosition) {
    EXPECT_EQ(through({}).rank, 0);
    EXPECT_EQ(through({{1, 2, 0}, {-3, -6, 0}}).rank, 1);
    EXPECT_EQ(through({{1, 2, 0}, {0, 3, 0}, {4, 5, 0}}).rank, 2);
    EXPECT_EQ(through({{1, 2, 0}, {0, 3, 0}, {4, 5, 6}}).rank, 3);
}

TEST(Lattice, OfMultiplesHasTheirGreatestCommonStep) {
    EXPECT_NEAR(shortest_step(through({{6, 0, 0}, {10, 0, 0}, {15, 0, 0}})), 1.0, 1e-12);
    EXPECT_NEAR(shortest_step(through({{0, 3, 4}, {0, 4.5, 6}})), 2.5, 1e-12);
}

TEST(Lattice, OfACentredCubeHasHalfItsVolume) {
    const Lattice lattice = through({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0.5}});
    EXPECT_NEAR(std::abs(glm::determinant(lattice.steps)), 0.5, 1e-12);
    EXPECT_NEAR(shortest_step(lattice), std::sqrt(0.75), 1e-12);
    EXPECT_FALSE(is_near_place(lattice, {0.5, 0.5, 0.0}));
}

TEST(Lattice, StepsAreTheShortestOnes) {
    // (1, 0, 0), (9, 1, 0) and (7, 5, 1) span all whole numbers.
    const Lattice lattice = through({{1, 0, 0}, {9, 1, 0}, {7, 5, 1}});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::length(lattice.steps[i]), 1.0, 1e-12);
}

TEST(Lattice, RefusesFractionsOfLessThanASixteenth) {
    Lattice lattice = through({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    EXPECT_TRUE(extend(lattice, {1.0 / 3.0, 1.0 / 5.0, 0}));  // fifteenths
    // No multiple of the first up to 16 is within 0.1 of a whole number where one of the second is.
    lattice = through({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    EXPECT_FALSE(extend(lattice, {1.0 / 17.0 + 0.06, 1.0 / 3.0, 1.0 / 7.0}));
}

TEST(Lattice, DividesOnlyStepsThatItHas) {
    // Fourteenths of all three are near whole numbers, and of the two that count sevenths are.
    const glm::dvec3 beside(-0.138, 0.279, -0.078);
    EXPECT_TRUE(is_near_place(through({{1, 0, 0}, {0, 1, 0}, beside}), beside));
}

TEST(Lattice, IndicesLeadBackToPlaces) {
    const Lattice lattice = through({{1, 2, 0}, {0, 3, 0}, {4, 5, 6}});
    const glm::dvec3 place = place_at(lattice, {3, -4, 5});
    EXPECT_EQ(index_of(lattice, place + 0.1), glm::dvec3(3, -4, 5));
    EXPECT_EQ(nearest_whole({2.4, -2.6, 0.0}), glm::dvec3(2, -3, 0));
}

}  // namespace
}  // namespace tetralight::detail
