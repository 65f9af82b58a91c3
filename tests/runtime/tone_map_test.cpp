// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/tone_map.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(ToneMap, BlackStaysBlack) {
    EXPECT_EQ(tone_map_neutral(glm::vec3(0.0f)), glm::vec3(0.0f));
}

TEST(ToneMap, BaseColoursLoseTheFresnelOffsetOnly) {
    // Below the compression and above the toe the curve is c − 0.04.
    const glm::vec3 mapped = tone_map_neutral({0.2f, 0.4f, 0.6f});
    EXPECT_NEAR(mapped.x, 0.16f, 1e-6f);
    EXPECT_NEAR(mapped.y, 0.36f, 1e-6f);
    EXPECT_NEAR(mapped.z, 0.56f, 1e-6f);
}

TEST(ToneMap, RisesAndNeverExceedsOne) {
    float previous = -1.0f;
    for (float x = 0.0f; x < 1e6f; x = x * 1.1f + 0.001f) {
        const float mapped = tone_map_neutral(glm::vec3(x)).x;
        EXPECT_GE(mapped, previous);
        EXPECT_LE(mapped, 1.0f);
        previous = mapped;
    }
    EXPECT_GT(previous, 0.99f);
}

TEST(ToneMap, IsContinuousWhereCompressionBegins) {
    const float below = tone_map_neutral(glm::vec3(0.7999f)).x;
    const float above = tone_map_neutral(glm::vec3(0.8001f)).x;
    EXPECT_NEAR(below, above, 5e-4f);
}

TEST(ToneMap, VeryBrightColoursTurnWhite) {
    const glm::vec3 mapped = tone_map_neutral({1000.0f, 0.0f, 0.0f});
    EXPECT_GT(mapped.y, 0.9f);
}

}  // namespace
}  // namespace tetralight
