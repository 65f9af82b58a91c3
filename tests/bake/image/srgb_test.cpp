// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/srgb.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tetralight {
namespace {

TEST(Srgb, EndpointsMapToThemselves) {
    EXPECT_EQ(linear_from_srgb(0.0f), 0.0f);
    EXPECT_NEAR(linear_from_srgb(1.0f), 1.0f, 1e-6f);
    EXPECT_EQ(srgb_from_linear(0.0f), 0.0f);
    EXPECT_EQ(srgb_from_linear(1.0f), 1.0f);
}

TEST(Srgb, IsLinearBelowTheKnee) {
    EXPECT_FLOAT_EQ(linear_from_srgb(0.04f), 0.04f / 12.92f);
    EXPECT_FLOAT_EQ(srgb_from_linear(0.003f), 0.003f * 12.92f);
}

TEST(Srgb, FollowsThePowerAboveTheKnee) {
    // 18 % grey and code 188 are known values: ((188/255 + 0.055) / 1.055)^2.4 = 0.5029.
    EXPECT_NEAR(linear_from_srgb(188.0f / 255.0f), 0.5028865f, 1e-5f);
    EXPECT_NEAR(srgb_from_linear(0.18f), 0.4613561f, 1e-5f);
}

TEST(Srgb, BothPiecesMeetAtTheKnee) {
    const float below = linear_from_srgb(0.04045f);
    const float above = linear_from_srgb(std::nextafter(0.04045f, 1.0f));
    EXPECT_NEAR(below, above, 1e-6f);
}

TEST(Srgb, TableAgreesWithTheCurve) {
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(linear_from_srgb8(static_cast<uint8_t>(code)),
                  linear_from_srgb(static_cast<float>(code) / 255.0f));
    }
}

TEST(Srgb, EveryCodeComesBack) {
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(srgb8_from_linear(linear_from_srgb8(static_cast<uint8_t>(code))), code);
    }
}

TEST(Srgb, EncodingClampsItsArgument) {
    EXPECT_EQ(srgb_from_linear(-1.0f), 0.0f);
    EXPECT_EQ(srgb_from_linear(7.0f), 1.0f);
    EXPECT_EQ(srgb8_from_linear(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(srgb8_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace tetralight
