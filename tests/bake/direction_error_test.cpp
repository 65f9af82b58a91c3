// SPDX-License-Identifier: Apache-2.0
#include "tests/support/direction_error.h"

#include <gtest/gtest.h>

namespace tetralight {
namespace {

/// Error of random directions over that of the rotated lattice, for 1024 of each.
double gain(const test::RadianceOf& radiance) {
    return test::direction_error(radiance, 1024, test::random_directions) /
           test::direction_error(radiance, 1024, test::rotated_lattice);
}

TEST(RotatedLattice, IntegratesAnEdgeEightTimesBetterThanRandomDirections) {
    EXPECT_GE(gain(test::edge_radiance), 8.0);
}

TEST(RotatedLattice, IntegratesASmallWindowBetterThanRandomDirections) {
    EXPECT_GE(gain(test::window_radiance), 3.5);
}

TEST(RotatedLattice, GainsLessOnACheckerTheFinerItIs) {
    // 1024 directions are 6.4° apart: fields of 22.5° hold a dozen, those of 11.25° three.
    EXPECT_GE(gain(test::checker_radiance(8)), 2.3);
    EXPECT_GE(gain(test::checker_radiance(16)), 1.5);
}

TEST(RandomDirections, HaveTheErrorOfTheirSampleCount) {
    // 1.28 / √N for constant radiance (every coefficient but the first has σ = c00 / √N).
    const double error =
        test::direction_error([](glm::vec3) { return 1.0f; }, 1024, test::random_directions);
    EXPECT_NEAR(error, 1.28 / 32.0, 0.1 * 1.28 / 32.0);
}

}  // namespace
}  // namespace tetralight
