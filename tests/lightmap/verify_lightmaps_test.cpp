// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/lightmap/lightmap_file.h>
#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

/// One broken field, and the field of the error.
struct Breakage {
    const char* field;
    void (*break_it)(Lightmaps&);
};

void expect_refused(const std::vector<Breakage>& breakages) {
    const Lightmaps sound = test::make_full_lightmaps();
    ASSERT_TRUE(verify(sound.view()));
    for (const Breakage& breakage : breakages) {
        Lightmaps broken = sound;
        breakage.break_it(broken);
        const Status status = verify(broken.view());
        ASSERT_FALSE(status) << breakage.field;
        EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
        EXPECT_EQ(status.error().field, breakage.field) << error_text(status.error());
    }
}

TEST(VerifyLightmaps, RefusesWrongFacts) {
    expect_refused({
        {"info.page_size", [](Lightmaps& l) { l.info.page_size = 0; }},
        {"info.page_size", [](Lightmaps& l) { l.info.page_size = 16385; }},
        {"irradiance", [](Lightmaps& l) { l.info.page_count = 3; }},
        // The product is 2^32 times the right one.
        {"irradiance", [](Lightmaps& l) { l.info.page_size = 4 << 10, l.info.page_count <<= 12; }},
        {"info.texels_per_meter", [](Lightmaps& l) { l.info.texels_per_meter = -1.0f; }},
        {"info.texels_per_meter", [](Lightmaps& l) { l.info.texels_per_meter = INFINITY; }},
        {"info.scale", [](Lightmaps& l) { l.info.scale = 0.0f; }},
        {"info.scale", [](Lightmaps& l) { l.info.scale = -0.5f; }},
        {"info.scale", [](Lightmaps& l) { l.info.scale = 0x1p65f; }},
        {"info.scale", [](Lightmaps& l) { l.info.scale = std::nanf(""); }},
        {"info.mixed_lighting",
         [](Lightmaps& l) { l.info.mixed_lighting = static_cast<MixedLighting>(3); }},
        {"info.ambient_occlusion_distance",
         [](Lightmaps& l) { l.info.ambient_occlusion_distance = -0.5f; }},
        {"info.ambient_occlusion_distance",
         [](Lightmaps& l) { l.info.ambient_occlusion_distance = std::nanf(""); }},
        {"info.reserved", [](Lightmaps& l) { l.info.reserved[9] = 1; }},
    });
}

TEST(VerifyLightmaps, RefusesCountsThatDoNotAgree) {
    expect_refused({
        {"irradiance", [](Lightmaps& l) { l.irradiance.pop_back(); }},
        {"irradiance", [](Lightmaps& l) { l.irradiance.clear(); }},
        {"light", [](Lightmaps& l) { l.light.pop_back(); }},
        {"validity", [](Lightmaps& l) { l.validity.pop_back(); }},
        {"error", [](Lightmaps& l) { l.error.push_back(0); }},
        {"shadow_mask", [](Lightmaps& l) { l.shadow_mask.pop_back(); }},
        {"ambient_occlusion", [](Lightmaps& l) { l.ambient_occlusion.push_back(0); }},
        {"instance_names", [](Lightmaps& l) { l.instance_names += "more\n"; }},
        {"layer_names", [](Lightmaps& l) { l.layer_names = "sky\n"; }},
        {"layer_names", [](Lightmaps& l) { l.layers.pop_back(); }},
        {"layer_irradiance", [](Lightmaps& l) { l.layer_irradiance.pop_back(); }},
        {"layer_light", [](Lightmaps& l) { l.layer_light.pop_back(); }},
    });
}

TEST(VerifyLightmaps, RefusesWrongRectangles) {
    expect_refused({
        {"rectangles[1]", [](Lightmaps& l) { l.rectangles[1].page = 2; }},
        {"rectangles[1]", [](Lightmaps& l) { l.rectangles[1].width = 4; }},
        {"rectangles[1]", [](Lightmaps& l) { l.rectangles[1].y = 0xffffffffu; }},
        {"rectangles[0]", [](Lightmaps& l) { l.rectangles[0].height = 0; }},
        {"rectangles[0]", [](Lightmaps& l) { l.rectangles[0].mesh = 1; }},
        {"rectangles[0]", [](Lightmaps& l) { l.rectangles[0].scale.x *= 1.001f; }},
        {"rectangles[0]", [](Lightmaps& l) { l.rectangles[0].offset.y = std::nanf(""); }},
        {"rectangles[0]", [](Lightmaps& l) { l.rectangles[0].reserved[1] = 1; }},
        {"rectangles[2]", [](Lightmaps& l) { l.rectangles[2].width = 1; }},
        {"rectangles[1]",
         [](Lightmaps& l) {
             l.rectangles[1] = test::rectangle_at(0, {2, 1, 1, 1}, 4);
         }},
    });
}

TEST(VerifyLightmaps, RefusesWrongMeshesTextsAndLayers) {
    expect_refused({
        {"meshes[0]", [](Lightmaps& l) { l.meshes[0].first_corner = 1; }},
        {"meshes[0]", [](Lightmaps& l) { l.meshes[0].triangle_count = 0xffffffffu; }},
        {"meshes[0]", [](Lightmaps& l) { l.meshes[0].reserved[0] = 1; }},
        {"corner_uvs[1]", [](Lightmaps& l) { l.corner_uvs[1].x = 1.1f; }},
        {"corner_uvs[2]", [](Lightmaps& l) { l.corner_uvs[2].y = std::nanf(""); }},
        {"instance_names", [](Lightmaps& l) { l.instance_names = "a\nb\nc"; }},
        {"instance_names", [](Lightmaps& l) { l.instance_names = "a\nb\n\xff\n"; }},
        {"layer_names", [](Lightmaps& l) { l.layer_names = "sky\nsky\n"; }},
        {"metadata", [](Lightmaps& l) { l.metadata = "{\"a\":\"\x1b\"}"; }},
        {"layers[1]", [](Lightmaps& l) { l.layers[1].weight = -1.0f; }},
        {"layers[1]", [](Lightmaps& l) { l.layers[1].weight = std::nanf(""); }},
        {"layers[0]", [](Lightmaps& l) { l.layers[0].scale = 0.3f; }},
        {"layers[0]", [](Lightmaps& l) { l.layers[0].reserved[0] = 1; }},
    });
}

TEST(VerifyLightmaps, RefusesHalvesThatAreNoLight) {
    expect_refused({
        {"irradiance[5]", [](Lightmaps& l) { l.irradiance[5].rgb[1] = 0x7c00; }},
        {"irradiance[5]", [](Lightmaps& l) { l.irradiance[5].rgb[2] = 0x8001; }},
        {"irradiance[5]", [](Lightmaps& l) { l.irradiance[5].coverage = 0x3c01; }},
        {"light[3]", [](Lightmaps& l) { l.light[3].flux[0] = 0xbc00; }},
        {"light[3]", [](Lightmaps& l) { l.light[3].vector[2][1] = 0xfc00; }},
        {"error[0]", [](Lightmaps& l) { l.error[0] = 0x7e00; }},
        {"layer_irradiance[40]", [](Lightmaps& l) { l.layer_irradiance[40].rgb[0] = 0xffff; }},
        {"layer_light[63]", [](Lightmaps& l) { l.layer_light[63].vector[0][0] = 0x7e01; }},
    });
}

TEST(VerifyLightmaps, TakesDirectionsBelowZeroAndMinusZero) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    lightmaps.light[0].vector[0][0] = 0xbc00;
    lightmaps.irradiance[0].rgb[0] = 0x8000;
    EXPECT_TRUE(verify(lightmaps.view()));
}

TEST(VerifyLightmaps, SaysWhichHalf) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    lightmaps.irradiance[5].rgb[1] = 0x7c00;
    EXPECT_EQ(error_text(verify(lightmaps.view()).error()),
              "section \"irradiance\": element 5: half 1 is out of range (0x7c00)");
}

/// A page of 128 x 128 rectangles of 3 x 3 texels, one texel apart.
Lightmaps make_grid_of_rectangles() {
    Lightmaps lightmaps = test::make_black_page(512);
    for (uint32_t y = 0; y < 512; y += 4) {
        for (uint32_t x = 0; x < 512; x += 4) {
            lightmaps.rectangles.push_back(test::rectangle_at(0, {x, y, 3, 3}, 512));
        }
    }
    return lightmaps;
}

TEST(VerifyLightmaps, FindsAnyOverlapOfManyRectangles) {
    Lightmaps lightmaps = make_grid_of_rectangles();
    EXPECT_TRUE(verify(lightmaps.view()));
    for (const size_t i : {size_t{130}, size_t{8000}, lightmaps.rectangles.size() - 130}) {
        for (const auto& [dx, dy] : {std::pair{2, 0}, {-2, 0}, {0, 2}, {0, -2}, {2, -2}}) {
            const LightmapRectangle right = lightmaps.rectangles[i];
            const uint32_t x = right.x + static_cast<uint32_t>(dx);
            const uint32_t y = right.y + static_cast<uint32_t>(dy);
            lightmaps.rectangles[i] = test::rectangle_at(0, {x, y, 3, 3}, 512);
            EXPECT_FALSE(verify(lightmaps.view())) << i << " by " << dx << ", " << dy;
            lightmaps.rectangles[i] = right;
        }
    }
}

TEST(VerifyLightmaps, RectanglesThatTouchDoNotOverlap) {
    Lightmaps lightmaps = test::make_black_page(8);
    lightmaps.rectangles = {
        test::rectangle_at(0, {0, 0, 4, 8}, 8), test::rectangle_at(0, {4, 0, 4, 4}, 8),
        test::rectangle_at(0, {4, 4, 2, 4}, 8), test::rectangle_at(0, {6, 4, 2, 4}, 8)};
    EXPECT_TRUE(verify(lightmaps.view()));
    lightmaps.rectangles.push_back(lightmaps.rectangles[3]);
    const Status status = verify(lightmaps.view());
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              "section \"rectangles\": element 4: overlaps rectangle 3 on page 0");
}

}  // namespace
}  // namespace tetralight
