// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmaps.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace tetralight {
namespace {

// docs/file_format.md gives these to other programs.
static_assert(offsetof(LightmapInfo, page_count) == 4 && offsetof(LightmapInfo, scale) == 12);
static_assert(offsetof(LightmapTexel, vector) == 6);
static_assert(offsetof(IrradianceTexel, coverage) == 6);
static_assert(offsetof(LightmapRectangle, offset) == 8 && offsetof(LightmapRectangle, page) == 16);
static_assert(offsetof(LightmapRectangle, x) == 20 && offsetof(LightmapRectangle, width) == 28);
static_assert(offsetof(LightmapRectangle, mesh) == 36);
static_assert(offsetof(LightmapMesh, first_corner) == 8);
static_assert(offsetof(LightmapMesh, triangle_count) == 12);
static_assert(offsetof(LightmapLayer, scale) == 4);

TEST(Lightmaps, ScaleIsTheSmallestPowerOfTwoThatBringsTheLightTo32768) {
    EXPECT_EQ(lightmap_scale(32768.0f), 1.0f);
    EXPECT_EQ(lightmap_scale(32769.0f), 2.0f);
    EXPECT_EQ(lightmap_scale(16384.0f), 0.5f);
    EXPECT_EQ(lightmap_scale(120000.0f), 4.0f);
}

TEST(Lightmaps, ScaleStaysInItsRange) {
    EXPECT_EQ(lightmap_scale(0.0f), 1.0f);
    EXPECT_EQ(lightmap_scale(1e-38f), 1.0f / kLargestLightmapScale);
    EXPECT_EQ(lightmap_scale(1e38f), kLargestLightmapScale);
}

TEST(Lightmaps, TransformMapsUnwrappedUvsToTheEdgesOfTheRectangle) {
    LightmapRectangle rectangle;
    rectangle.x = 64;
    rectangle.y = 128;
    rectangle.width = 32;
    rectangle.height = 16;
    set_page_transform(rectangle, 256);
    EXPECT_EQ(rectangle.offset, glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(rectangle.offset + rectangle.scale, glm::vec2(96.0f / 256.0f, 144.0f / 256.0f));
}

TEST(Lightmaps, CountOfTexelsExceeds32Bits) {
    LightmapsView view;
    view.info.page_size = kLargestPageSize;
    view.info.page_count = 64;
    EXPECT_EQ(view.texel_count(), uint64_t{1} << 34);
}

}  // namespace
}  // namespace tetralight
