// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/sample_lightmap.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

/// The UV of the center of a texel, or between centers.
float center_of(float texel, uint32_t page_size) {
    return (texel + 0.5f) / static_cast<float>(page_size);
}

/// A page of 8 x 8 texels with irradiance (x, y, x + y).
Lightmaps make_ramp() {
    Lightmaps ramp = test::make_black_page(8);
    for (size_t i = 0; i < 64; ++i) {
        const auto x = static_cast<float>(i % 8), y = static_cast<float>(i / 8);
        ramp.irradiance[i] = test::texel_of({x, y, x + y});
    }
    return ramp;
}

TEST(FloatFromHalf, IsExactForEachHalf) {
    for (uint32_t half = 0; half < 0x7c00; ++half) {
        const int exponent = static_cast<int>(half >> 10);
        const auto mantissa = static_cast<float>(half & 0x3ff);
        const float value = exponent == 0 ? std::ldexp(mantissa, -24)
                                          : std::ldexp(mantissa + 1024.0f, exponent - 25);
        ASSERT_EQ(float_from_half(static_cast<uint16_t>(half)), value);
        ASSERT_EQ(float_from_half(static_cast<uint16_t>(half | 0x8000)), -value);
    }
    for (uint32_t half = 0x7c00; half <= 0x7fff; ++half) {
        ASSERT_GE(float_from_half(static_cast<uint16_t>(half)), 65536.0f);
        ASSERT_LT(float_from_half(static_cast<uint16_t>(half)), 131072.0f);
    }
}

TEST(SampleIrradiance, OfAConstantPageIsThatConstant) {
    Lightmaps lightmaps = test::make_black_page(4);
    const glm::vec3 light(0.5f, 1024.0f, 3.0f);
    lightmaps.irradiance.assign(16, test::texel_of(light));
    for (const float u : {-3.0f, 0.0f, 0.125f, 0.25f, 0.5f, 0.875f, 1.0f, 7.0f}) {
        EXPECT_EQ(sample_irradiance(lightmaps.view(), 0, {u, 1.0f - u}), light);
    }
}

TEST(SampleIrradiance, OfARampIsLinearBetweenCenters) {
    const Lightmaps ramp = make_ramp();
    for (float x = 0.0f; x <= 7.0f; x += 0.25f) {
        for (float y = 0.0f; y <= 7.0f; y += 0.25f) {
            EXPECT_EQ(sample_irradiance(ramp.view(), 0, {center_of(x, 8), center_of(y, 8)}),
                      glm::vec3(x, y, x + y));
        }
    }
}

TEST(SampleIrradiance, IsClampedAtTheBordersOfThePage) {
    const Lightmaps ramp = make_ramp();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float low : {0.0f, 0.0625f, -0.5f, -1e30f, -kInfinity}) {
        EXPECT_EQ(sample_irradiance(ramp.view(), 0, {low, 0.5f}), glm::vec3(0.0f, 3.5f, 3.5f));
        EXPECT_EQ(sample_irradiance(ramp.view(), 0, {0.5f, low}), glm::vec3(3.5f, 0.0f, 3.5f));
    }
    for (const float high : {1.0f, 0.9375f, 1.5f, 1e30f, kInfinity}) {
        EXPECT_EQ(sample_irradiance(ramp.view(), 0, {high, 0.5f}), glm::vec3(7.0f, 3.5f, 10.5f));
        EXPECT_EQ(sample_irradiance(ramp.view(), 0, {0.5f, high}), glm::vec3(3.5f, 7.0f, 10.5f));
    }
}

TEST(SampleIrradiance, TakesUvsThatAreNoNumbersAs0) {
    const float nan = std::nanf("");
    EXPECT_EQ(sample_irradiance(make_ramp().view(), 0, {nan, nan}), glm::vec3(0.0f));
}

TEST(SampleIrradiance, DoesNotMixPages) {
    Lightmaps lightmaps = test::make_black_page(2);
    lightmaps.info.page_count = 2;
    lightmaps.irradiance.resize(8, test::texel_of(glm::vec3(1.0f)));
    EXPECT_EQ(sample_irradiance(lightmaps.view(), 0, {0.5f, 1.0f}), glm::vec3(0.0f));
    EXPECT_EQ(sample_irradiance(lightmaps.view(), 1, {0.5f, 0.0f}), glm::vec3(1.0f));
}

TEST(SampleIrradiance, IsTheHalfTimesTheScale) {
    Lightmaps lightmaps = test::make_black_page(1);
    lightmaps.irradiance[0] = test::texel_of({3.0f, 0.0f, 65504.0f});
    lightmaps.info.scale = 4.0f;
    EXPECT_EQ(sample_irradiance(lightmaps.view(), 0, {0.5f, 0.5f}),
              glm::vec3(12.0f, 0.0f, 4.0f * 65504.0f));
}

TEST(SampleIrradiance, FollowsScaleAndOffsetOfTheRectangle) {
    const Lightmaps ramp = make_ramp();
    const LightmapRectangle rectangle = test::rectangle_at(0, {2, 4, 4, 2}, 8);
    // The center of the rectangle lies between texels 3 and 4, and 4 and 5.
    const glm::vec2 uv = page_uv(rectangle, {0.5f, 0.5f});
    EXPECT_EQ(sample_irradiance(ramp.view(), 0, uv), glm::vec3(3.5f, 4.5f, 8.0f));
}

TEST(SampleIrradiance, IsBlackWherePagesAreMissing) {
    Lightmaps lightmaps = test::make_black_page(2);
    lightmaps.irradiance.assign(4, test::texel_of(glm::vec3(1.0f)));
    const auto is_black = [&](uint32_t page) {
        return sample_irradiance(lightmaps.view(), page, {0.5f, 0.5f}) == glm::vec3(0.0f);
    };
    EXPECT_FALSE(is_black(0));
    EXPECT_TRUE(is_black(1));
    EXPECT_TRUE(is_black(kNoIndex));
    lightmaps.info.page_count = kNoIndex;  // more than there are texels for
    EXPECT_TRUE(is_black(1));
    for (const uint32_t size : {0u, 3u, 16385u, 65536u, kNoIndex}) {
        lightmaps.info.page_size = size;
        EXPECT_TRUE(is_black(0)) << size;
    }
}

TEST(SampleIrradiance, IsBlackIfTheScaleIsNoScale) {
    Lightmaps lightmaps = test::make_black_page(1);
    lightmaps.irradiance[0] = test::texel_of(glm::vec3(1.0f));
    for (const float scale : {0.0f, -1.0f, std::nanf(""), INFINITY}) {
        lightmaps.info.scale = scale;
        EXPECT_EQ(sample_irradiance(lightmaps.view(), 0, {0.5f, 0.5f}), glm::vec3(0.0f)) << scale;
    }
}

TEST(SampleIrradiance, InBatchesHasTheBitsOfOneSample) {
    const Lightmaps lightmaps = test::make_full_lightmaps();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-0.2f, 1.2f);
    for (const size_t count : {0u, 1u, 15u, 16u, 17u, 31u, 32u, 100u}) {
        std::vector<uint32_t> pages;
        std::vector<glm::vec2> uvs;
        for (size_t i = 0; i < count; ++i) {
            pages.push_back(static_cast<uint32_t>(random() % 3));  // one is out of range
            uvs.emplace_back(coordinate(random), coordinate(random));
        }
        std::vector<glm::vec3> batch(count, glm::vec3(-1.0f));
        sample_irradiance(lightmaps.view(), pages, uvs, batch);
        for (size_t i = 0; i < count; ++i) {
            ASSERT_EQ(batch[i], sample_irradiance(lightmaps.view(), pages[i], uvs[i])) << i;
        }
    }
}

TEST(SampleIrradiance, InBatchesWithoutPagesIsBlack) {
    const std::vector<uint32_t> pages(20, 0);
    const std::vector<glm::vec2> uvs(20, glm::vec2(0.5f));
    std::vector<glm::vec3> batch(20, glm::vec3(-1.0f));
    sample_irradiance(LightmapsView{}, pages, uvs, batch);
    EXPECT_EQ(batch, std::vector<glm::vec3>(20, glm::vec3(0.0f)));
}

TEST(SampleLightmap, OfLightFromOneDirectionFollowsItsCosine) {
    Lightmaps lightmaps = test::make_black_page(2);
    lightmaps.info.scale = 2.0f;
    lightmaps.light.assign(4, test::light_of({1.0f, 2.0f, 4.0f}, {0.0f, 1.0f, 0.0f}));
    const glm::vec3 base(0.0f, 1.0f, 0.0f);
    const auto lit = [&](const glm::vec3& normal) {
        return sample_lightmap(lightmaps.view(), 0, {0.3f, 0.7f}, {base, normal});
    };
    EXPECT_EQ(lit(base), glm::vec3(2.0f, 4.0f, 8.0f));
    EXPECT_EQ(lit({0.8f, 0.6f, 0.0f}), glm::vec3(2.0f, 4.0f, 8.0f) * 0.6f);
    EXPECT_EQ(lit({0.0f, -1.0f, 0.0f}), glm::vec3(0.0f));
}

TEST(SampleLightmap, OfAUniformSkyFollowsItsVisiblePart) {
    Lightmaps lightmaps = test::make_black_page(2);
    lightmaps.light.assign(4, test::light_of({2.0f, 4.0f, 8.0f}, {0.0f, 0.5f, 0.0f}));
    for (LightmapTexel& texel : lightmaps.light) {
        // v = φ / 2.
        EXPECT_EQ(float_from_half(texel.vector[2][1]), 4.0f);
    }
    const glm::vec3 lit = sample_lightmap(lightmaps.view(), 0, {0.3f, 0.7f},
                                          {{0.0f, 1.0f, 0.0f}, {0.8f, 0.6f, 0.0f}});
    EXPECT_LT(glm::distance(lit, 0.25f * 1.6f * glm::vec3(2.0f, 4.0f, 8.0f)), 1e-3f);
}

TEST(SampleLightmap, InterpolatesTheLightOfEachChannel) {
    Lightmaps lightmaps = test::make_black_page(2);
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const auto bright = test::light_of({4.0f, 0.0f, 8.0f}, up);
    const auto dark = test::light_of({8.0f, 4.0f, 0.0f}, 0.5f * up);
    lightmaps.light = {bright, dark, bright, dark};
    // A quarter of the way between the centers at u = 0.25 and 0.75.
    const glm::vec3 lit = sample_lightmap(lightmaps.view(), 0, {0.375f, 0.5f}, {up, up});
    EXPECT_LT(glm::distance(lit, glm::vec3(4.0f, 0.5f, 6.0f)), 1e-5f);
}

TEST(SampleLightmap, WithoutLightIsTheIrradiance) {
    const Lightmaps ramp = make_ramp();
    EXPECT_EQ(sample_lightmap(ramp.view(), 0, {0.4f, 0.6f}, {{0, 1, 0}, {0, 1, 0}}),
              sample_irradiance(ramp.view(), 0, {0.4f, 0.6f}));
}

TEST(SampleLightmap, IsBlackWhereTexelsAreMissing) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    lightmaps.light.resize(31);  // the second page is not whole
    const MappedNormals up{{0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    EXPECT_EQ(sample_lightmap(lightmaps.view(), 1, {0.5f, 0.5f}, up), glm::vec3(0.0f));
    EXPECT_NE(sample_lightmap(lightmaps.view(), 0, {0.5f, 0.5f}, up), glm::vec3(0.0f));
}

TEST(SampleShadowMask, InterpolatesTheBytesOfEachChannel) {
    Lightmaps maps = test::make_black_page(2);
    EXPECT_EQ(sample_shadow_mask(maps.view(), 0, {0.5f, 0.5f}), glm::vec4(1.0f));
    EXPECT_EQ(sample_ambient_occlusion(maps.view(), 0, {0.5f, 0.5f}), 1.0f);
    maps.info.scale = 0.25f;  // of light alone
    maps.shadow_mask = {{0, 255, 51, 0}, {255, 255, 51, 0}, {0, 255, 51, 0}, {255, 255, 51, 255}};
    maps.ambient_occlusion = {0, 0, 255, 255};
    const glm::vec4 middle = sample_shadow_mask(maps.view(), 0, {0.5f, 0.5f});
    EXPECT_NEAR(middle.x, 0.5f, 1e-6f);
    EXPECT_NEAR(middle.y, 1.0f, 1e-6f);
    EXPECT_NEAR(middle.z, 0.2f, 1e-6f);
    EXPECT_NEAR(middle.w, 0.25f, 1e-6f);
    EXPECT_NEAR(sample_ambient_occlusion(maps.view(), 0, {0.3f, 0.5f}), 0.5f, 1e-6f);
    EXPECT_NEAR(sample_ambient_occlusion(maps.view(), 0, {0.3f, 0.625f}), 0.75f, 1e-6f);
    EXPECT_EQ(sample_shadow_mask(maps.view(), 7, {0.5f, 0.5f}), glm::vec4(1.0f));
}

}  // namespace
}  // namespace tetralight
