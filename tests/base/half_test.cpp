// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/half.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tetralight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The value of a finite, positive half.
float float_from_half(uint16_t half) {
    const int exponent = half >> 10;
    const auto mantissa = static_cast<float>(half & 0x3ff);
    return exponent == 0 ? std::ldexp(mantissa, -24)
                         : std::ldexp(mantissa + 1024.0f, exponent - 25);
}

TEST(Half, ConvertsEveryFiniteHalfToItself) {
    for (uint16_t half = 0; half < 0x7c00; ++half) {
        const float value = float_from_half(half);
        ASSERT_EQ(half_from_float(value), half);
        ASSERT_EQ(half_from_float(-value), half | 0x8000);
        ASSERT_EQ(half_from_float_saturated(value), half);
    }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
    for (uint16_t half = 0; half < 0x7bff; ++half) {
        const auto next = static_cast<uint16_t>(half + 1);
        const float tie = 0.5f * (float_from_half(half) + float_from_half(next));
        const uint16_t even = (half & 1) == 0 ? half : next;
        ASSERT_EQ(half_from_float(tie), even) << tie;
        ASSERT_EQ(half_from_float(-tie), even | 0x8000) << tie;
        ASSERT_EQ(half_from_float(std::nextafter(tie, 0.0f)), half) << tie;
        ASSERT_EQ(half_from_float(std::nextafter(tie, 1e9f)), next) << tie;
    }
}

TEST(Half, IsInfiniteFrom65520OnUnlessSaturated) {
    EXPECT_EQ(half_from_float(65519.0f), 0x7bff);
    for (const float large : {65520.0f, 70000.0f, 1e6f, 3e38f, kInfinity}) {
        EXPECT_EQ(half_from_float(large), 0x7c00);
        EXPECT_EQ(half_from_float(-large), 0xfc00);
        EXPECT_EQ(half_from_float_saturated(large), 0x7bff);
        EXPECT_EQ(half_from_float_saturated(-large), 0xfbff);
    }
}

TEST(Half, KeepsNan) {
    EXPECT_GT(half_from_float(std::nanf("")) & 0x7fff, 0x7c00);
    EXPECT_GT(half_from_float_saturated(std::nanf("")) & 0x7fff, 0x7c00);
}

}  // namespace
}  // namespace tetralight
