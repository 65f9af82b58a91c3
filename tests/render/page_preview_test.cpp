// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/page_preview.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

using Pixel = std::array<uint8_t, 4>;

/// Two rectangles of light in one page of 32 texels, on the left and on the right.
Lightmaps two_rectangles() {
    Lightmaps maps;
    maps.info.page_size = 32;
    maps.info.page_count = 1;
    maps.irradiance.resize(32 * 32);
    maps.instance_names = "left\nright\n";
    for (const uint32_t x : {1u, 17u}) {
        LightmapRectangle& rectangle = maps.rectangles.emplace_back();
        rectangle.page = 0;
        rectangle.x = x;
        rectangle.y = 2;
        rectangle.width = rectangle.height = 12;
        for (uint32_t i = 0; i < 144; ++i)
            maps.irradiance[(2 + i / 12) * 32 + x + i % 12] = {{0x3c00, 0x3c00, 0x3c00}, kCovered};
    }
    return maps;
}

Image8 preview(const Lightmaps& maps, const std::vector<bool>& is_marked) {
    const auto values = map_values(maps.view(), LightmapMap::Irradiance);
    return page_preview(maps.view(), *values, 0, is_marked);
}

Pixel pixel(const Image8& image, uint32_t x, uint32_t y) {
    return image.pixels[size_t{y} * image.width + x];
}

TEST(PagePreview, RectanglesHaveBorders) {
    const Lightmaps maps = two_rectangles();
    const Image8 image = preview(maps, {false, false});
    EXPECT_EQ(pixel(image, 1, 2), pixel(image, 17, 2));
    EXPECT_EQ(pixel(image, 1, 13), pixel(image, 12, 2));
    EXPECT_NE(pixel(image, 1, 2), pixel(image, 2, 3));  // border, light
    EXPECT_NE(pixel(image, 6, 6), pixel(image, 0, 0));  // light, nothing
    EXPECT_EQ(pixel(image, 6, 6), pixel(image, 22, 6));
}

TEST(PagePreview, MarkedObjectsStandOut) {
    const Lightmaps maps = two_rectangles();
    const std::vector<bool> marked = instances_named(maps.view(), {"right"});
    EXPECT_EQ(marked, (std::vector<bool>{false, true}));
    const Image8 image = preview(maps, marked);
    EXPECT_NE(pixel(image, 1, 2), pixel(image, 17, 2));
    EXPECT_EQ(pixel(image, 17, 2), pixel(image, 19, 4));  // three texels wide
    EXPECT_GT(pixel(image, 22, 6)[0], pixel(image, 6, 6)[0]);
}

TEST(PagePreview, OtherNamesMarkNothing) {
    EXPECT_EQ(instances_named(two_rectangles().view(), {"", "top"}),
              (std::vector<bool>{false, false}));
}

}  // namespace
}  // namespace tetralight
