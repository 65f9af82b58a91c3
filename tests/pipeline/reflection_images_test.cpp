// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/base/half.h>
#include <tetralight/pipeline/reflection_images.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {
namespace {

/// Two probes of 16 and 8 texels a side. A texel says where it is: face and probe, column, row.
Reflections numbered_cubes() {
    Reflections all;
    all.size = 16;
    all.probes.resize(2);
    for (uint32_t level = 0; level < 2; ++level) {
        const uint32_t size = all.size >> level;
        auto& texels = all.levels.emplace_back();
        for (uint32_t slice = 0; slice < 2 * kCubeFaceCount; ++slice) {
            for (uint32_t i = 0; i < size * size; ++i) {
                texels.push_back({half_from_float(static_cast<float>(slice)),
                                  half_from_float(static_cast<float>(i % size)),
                                  half_from_float(static_cast<float>(i / size)),
                                  half_from_float(1.0f)});
            }
        }
    }
    return all;
}

TEST(ReflectionImages, AStripHasTheFacesInTheirOrder) {
    const Reflections all = numbered_cubes();
    const ImageF strip = cube_strip(all.view(), 1, 0);
    ASSERT_EQ(strip.width, 16u);
    ASSERT_EQ(strip.height, 96u);
    ASSERT_EQ(strip.pixels.size(), 16u * 96u);
    const ImageF small = cube_strip(all.view(), 1, 1);
    for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
        const size_t row = size_t{face} * 16 + 7;
        EXPECT_EQ(strip.pixels[row * 16 + 3], glm::vec3(6 + face, 3, 7));
        EXPECT_EQ(small.pixels[(size_t{face} * 8 + 2) * 8 + 5], glm::vec3(6 + face, 5, 2));
    }
}

TEST(ReflectionImages, RgbdKeepsTheLargestChannelToAPart) {
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

TEST(ReflectionImages, RgbdDividesThePowerOfRgbByAlpha) {
    EXPECT_EQ(decode_rgbd({255, 255, 255, 255}), glm::vec3(1.0f));
    const glm::vec3 light = decode_rgbd({128, 0, 0, 51});
    EXPECT_NEAR(light.x, 5.0f * std::pow(128.0f / 255.0f, 2.2f), 1e-5f);
}

TEST(ReflectionImages, RgbdClampsWhatItCannotHold) {
    const Image8 encoded = encode_rgbd({3, 1, {{255, 0, 0}, {1000, 510, 1}, {-1, -2, 0}}});
    const std::array<uint8_t, 4> largest{255, 0, 0, 1};
    EXPECT_EQ(encoded.pixels[0], largest);
    EXPECT_EQ(decode_rgbd(encoded.pixels[1]).y, 255.0f);
    EXPECT_EQ(decode_rgbd(encoded.pixels[2]), glm::vec3(0.0f));
}

}  // namespace
}  // namespace tetralight
