// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/spread.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/random_probes.h"

namespace tetralight::detail {
namespace {

/// Random positions squeezed to a dimension, then turned and moved.
std::vector<glm::dvec3> squeezed(const glm::dvec3& scale, uint64_t seed) {
    std::vector<glm::dvec3> positions = test::random_positions(30, seed);
    const glm::dmat4 world = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(50, -20, 7)),
                                         0.3 + static_cast<double>(seed), glm::dvec3(1, 2, 3));
    for (glm::dvec3& p : positions) p = glm::dvec3(world * glm::dvec4(p * scale, 1.0));
    return positions;
}

TEST(Spread, KnowsTheDimensionOfExactSets) {
    EXPECT_EQ(measure_spread({}, 0.0).dimension, Dimension::None);
    EXPECT_EQ(measure_spread(std::vector{glm::dvec3(3, 4, 5)}, 0.0).dimension, Dimension::Point);
    for (uint64_t seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(measure_spread(squeezed({1, 0, 0}, seed), 0.0).dimension, Dimension::Line);
        EXPECT_EQ(measure_spread(squeezed({1, 1, 0}, seed), 0.0).dimension, Dimension::Plane);
        EXPECT_EQ(measure_spread(squeezed({1, 1, 1}, seed), 0.0).dimension, Dimension::Space);
    }
}

TEST(Spread, CountsWhatIsThinnerThanTheFlatnessAsFlat) {
    const auto thin = squeezed({1, 1, 1e-4}, 1);
    EXPECT_EQ(measure_spread(thin, 1e-5).dimension, Dimension::Space);
    EXPECT_EQ(measure_spread(thin, 1e-3).dimension, Dimension::Plane);
    const auto needle = squeezed({1, 1e-4, 1e-4}, 2);
    EXPECT_EQ(measure_spread(needle, 1e-3).dimension, Dimension::Line);
}

TEST(Spread, AxisIsThatOfTheSetWhateverItsOrder) {
    auto positions = squeezed({1, 1, 0}, 3);
    const glm::dvec3 axis = measure_spread(positions, 0.0).axis();
    for (const glm::dvec3& p : positions) {
        EXPECT_NEAR(glm::dot(p - positions[0], axis), 0.0, 1e-12);
    }
    std::reverse(positions.begin(), positions.end());
    EXPECT_EQ(measure_spread(positions, 0.0).axis(), axis);
}

TEST(Spread, ProjectionKeepsLengthsInThePlane) {
    const auto positions = squeezed({1, 1, 0}, 4);
    const auto flat = project(positions, measure_spread(positions, 0.0).normal);
    for (size_t i = 1; i < positions.size(); ++i) {
        EXPECT_NEAR(glm::distance(flat[i], flat[0]), glm::distance(positions[i], positions[0]),
                    1e-12);
    }
}

}  // namespace
}  // namespace tetralight::detail
