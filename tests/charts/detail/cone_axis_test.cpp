// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/cone_axis.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace tetralight::detail {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A unit vector so many degrees from z towards x.
glm::dvec3 tilted(double degrees) {
    return {std::sin(degrees * kDegree), 0.0, std::cos(degrees * kDegree)};
}

TEST(ConeAxis, KeepsAStartThatIsRight) {
    const std::vector<glm::dvec3> normals{tilted(10), tilted(-10)};
    EXPECT_EQ(find_cone_axis(normals, tilted(3), std::cos(20 * kDegree)), tilted(3));
}

TEST(ConeAxis, TurnsBetweenTheOuterNormals) {
    std::vector<glm::dvec3> normals(100, tilted(-40));
    normals.push_back(tilted(40));
    const double min_cosine = std::cos(42 * kDegree);
    const auto axis = find_cone_axis(normals, tilted(-40), min_cosine);
    ASSERT_TRUE(axis);
    for (const glm::dvec3& normal : normals) EXPECT_GE(glm::dot(*axis, normal), min_cosine);
}

TEST(ConeAxis, FindsNoneForNormalsFartherApartThanTheConeIsWide) {
    EXPECT_FALSE(
        find_cone_axis(std::vector{tilted(-43), tilted(43)}, tilted(0), std::cos(42 * kDegree)));
    EXPECT_FALSE(
        find_cone_axis(std::vector{tilted(0), tilted(180)}, tilted(90), std::cos(42 * kDegree)));
}

TEST(ConeAxis, ZeroVectorsDoNotCount) {
    EXPECT_EQ(find_cone_axis(std::vector{tilted(1), glm::dvec3(0.0)}, tilted(0), 0.5), tilted(0));
    EXPECT_EQ(find_cone_axis({}, tilted(0), 0.5), tilted(0));
}

}  // namespace
}  // namespace tetralight::detail
