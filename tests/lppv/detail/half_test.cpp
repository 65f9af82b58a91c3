// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/half.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace tetralight::detail {
namespace {

TEST(Half, EveryHalfComesBack) {
    for (uint32_t half = 0; half < 0x10000u; ++half) {
        const float value = glm::unpackHalf1x16(static_cast<uint16_t>(half));
        if (std::isfinite(value)) {
            ASSERT_EQ(half_from_float(value), half);
        }
    }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
    for (uint16_t half = 0; half < 0x7bff; ++half) {
        const float low = glm::unpackHalf1x16(half);
        const float high = glm::unpackHalf1x16(static_cast<uint16_t>(half + 1));
        const float middle = 0.5f * (low + high);
        const uint16_t even = (half & 1) == 0 ? half : static_cast<uint16_t>(half + 1);
        ASSERT_EQ(half_from_float(middle), even) << middle;
        ASSERT_EQ(half_from_float(-middle), even | 0x8000) << middle;
        ASSERT_EQ(half_from_float(std::nextafter(middle, 0.0f)), half) << middle;
        ASSERT_EQ(half_from_float(std::nextafter(middle, 1e9f)), half + 1) << middle;
    }
}

TEST(Half, SaturatesAndKeepsNan) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float large : {65504.0f, 65519.0f, 65520.0f, 1e6f, 3e38f, kInfinity}) {
        EXPECT_EQ(half_from_float(large), 0x7bff);
        EXPECT_EQ(half_from_float(-large), 0xfbff);
    }
    EXPECT_TRUE(std::isnan(glm::unpackHalf1x16(half_from_float(std::nanf("")))));
}

}  // namespace
}  // namespace tetralight::detail
