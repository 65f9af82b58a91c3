// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tetralight
