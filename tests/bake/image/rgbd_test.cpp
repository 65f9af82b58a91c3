// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/rgbd.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tetralight {
namespace {

TEST(Rgbd, KeepsTheLargestChannelToAPart) {
    ImageF image{1000, 1, {}};
    for (int i = 0; i < 1000; ++i) {
        const float light = 0.01f * std::pow(25500.0f, static_cast<float>(i) / 999.0f);
        image.pixels.emplace_back(0.3f * light, light, 0.0f);
    }
    const Image8 encoded = encode_rgbd(image);
    for (size_t i = 0; i < 1000; ++i) {
        const glm::vec3 light = image.pixels[i], decoded = decode_rgbd(encoded.pixels[i]);
        const float part = light.y < 0.25f ? 0.04f : 0.01f;
        EXPECT_NEAR(decoded.y, light.y, part * light.y) << light.y;
        EXPECT_NEAR(decoded.x, light.x, part * light.y) << light.y;
        EXPECT_EQ(decoded.z, 0.0f);
    }
}

TEST(Rgbd, DividesThePowerOfRgbByAlpha) {
    EXPECT_EQ(decode_rgbd({255, 255, 255, 255}), glm::vec3(1.0f));
    const glm::vec3 light = decode_rgbd({128, 0, 0, 51});
    EXPECT_NEAR(light.x, 5.0f * std::pow(128.0f / 255.0f, 2.2f), 1e-5f);
}

TEST(Rgbd, ClampsWhatItCannotHold) {
    const Image8 encoded = encode_rgbd({3, 1, {{255, 0, 0}, {1000, 510, 1}, {-1, -2, 0}}});
    const std::array<uint8_t, 4> largest{255, 0, 0, 1};
    EXPECT_EQ(encoded.pixels[0], largest);
    EXPECT_EQ(decode_rgbd(encoded.pixels[1]).y, 255.0f);
    EXPECT_EQ(decode_rgbd(encoded.pixels[2]), glm::vec3(0.0f));
}

TEST(Rgbd, AnAlphaOfZeroIsReadAsTheSmallestOne) {
    EXPECT_EQ(decode_rgbd({200, 0, 7, 0}), decode_rgbd({200, 0, 7, 1}));
}

TEST(Rgbd, AnImageIsDecodedPixelByPixel) {
    const Image8 image{2, 1, {{255, 0, 0, 51}, {10, 20, 30, 255}}};
    const ImageF light = decode_rgbd(image);
    EXPECT_EQ(light.width, 2u);
    EXPECT_EQ(light.height, 1u);
    ASSERT_EQ(light.pixels.size(), 2u);
    EXPECT_FLOAT_EQ(light.pixels[0].x, 5.0f);
    EXPECT_EQ(light.pixels[1], decode_rgbd({10, 20, 30, 255}));
}

}  // namespace
}  // namespace tetralight
