// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/local_origin.h>

#include <gtest/gtest.h>

#include "tests/support/probe_families.h"

namespace tetralight::detail {
namespace {

TEST(LocalOrigin, IsTheWorldsUnlessTheProbesAreFarFromIt) {
    const auto room = test::random_positions(1000, 1);
    EXPECT_EQ(local_origin({}), glm::dvec3(0.0));
    EXPECT_EQ(local_origin(room), glm::dvec3(0.0));
    EXPECT_EQ(local_origin(test::moved(room, glm::dvec3(1), {20, 0, 0})), glm::dvec3(0.0));
    const glm::dvec3 far = local_origin(test::moved(room, glm::dvec3(1), {1e5, 0, 0}));
    EXPECT_NEAR(far.x, 1e5, 1.0);
    EXPECT_EQ(far, glm::dvec3(glm::vec3(far)));  // floats hold it
}

TEST(LocalOrigin, OneProbeFarAwayDoesNotMoveIt) {
    const auto room = test::random_positions(1000, 2);
    EXPECT_EQ(local_origin(test::joined(room, {{1e9, 1e9, 1e9}})), glm::dvec3(0.0));
    const auto far = test::moved(room, glm::dvec3(1), {1e5, 0, 0});
    EXPECT_NEAR(local_origin(test::joined(far, {{0, 0, 0}})).x, 1e5, 1.0);
}

TEST(LocalOrigin, OfTwoProbesIsBetweenThem) {
    EXPECT_EQ(local_origin(std::vector<glm::dvec3>{{1000, 0, 0}, {1002, 0, 0}}),
              glm::dvec3(1001, 0, 0));
}

}  // namespace
}  // namespace tetralight::detail
