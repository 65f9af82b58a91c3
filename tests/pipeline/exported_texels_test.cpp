// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/exported_texels.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/lightmap/directional_light.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include "tests/lightmap/lightmap_fixture.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A page of one texel with light that has this φ and v of each channel, on a surface whose normal
/// is +y.
Lightmaps page_of(float flux, glm::vec3 vector) {
    Lightmaps maps = test::make_black_page(1);
    LightmapTexel light;
    for (size_t channel = 0; channel < 3; ++channel) {
        light.flux[channel] = half_from_float(flux);
        for (size_t axis = 0; axis < 3; ++axis)
            light.vector[channel][axis] = half_from_float(vector[static_cast<int>(axis)]);
    }
    maps.light = {light};
    maps.irradiance[0] = test::texel_of(glm::vec3(vector.y));
    return maps;
}

const glm::vec3 kUp(0.0f, 1.0f, 0.0f);

/// Unity's directional mode: shaders decode so.
float decoded(const glm::vec4& direction, glm::vec3 normal) {
    const glm::vec3 xyz(direction);
    return (glm::dot(normal, xyz - 0.5f) + 0.5f) / std::max(1e-4f, direction.w);
}

TEST(MapValues, DirectionChangesNothingOnTheSurfaceItself) {
    const glm::vec3 sun = glm::normalize(glm::vec3(0.3f, 0.8f, -0.4f));
    for (const Lightmaps& maps : {page_of(2.0f, 2.0f * sun), page_of(2.0f, kUp),
                                  page_of(3.0f, 0.3f * sun), page_of(0.0f, glm::vec3(0.0f))}) {
        const auto values = map_values(maps.view(), LightmapMap::Direction);
        ASSERT_TRUE(values);
        EXPECT_TRUE(values->is_fraction);
        EXPECT_EQ(values->channel_count, 4u);
        EXPECT_NEAR(decoded(values->at(0), kUp), 1.0f, 2e-3f);
    }
}

TEST(MapValues, DirectionOfAUniformSkyFollowsItsView) {
    // φ = 2 π, v = π n0: a normal at an angle θ sees (1 + cos θ) / 2 of it.
    constexpr float kPi = std::numbers::pi_v<float>;
    const Lightmaps maps = page_of(2.0f * kPi, kPi * kUp);
    const auto values = map_values(maps.view(), LightmapMap::Direction);
    const glm::vec3 tilted(std::sin(0.7f), std::cos(0.7f), 0.0f);
    EXPECT_NEAR(decoded(values->at(0), tilted), 0.5f + 0.5f * std::cos(0.7f), 2e-3f);
}

TEST(MapValues, MonoShIsTheDirectionOfAllChannels) {
    const glm::vec3 v(0.2f, 0.6f, 0.1f);
    const Lightmaps maps = page_of(1.0f, v);
    const auto values = map_values(maps.view(), LightmapMap::MonoSh);
    ASSERT_TRUE(values);
    const glm::vec4 value = values->at(0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(2.0f * value[i] - 1.0f, v[i], 1e-3f);
}

TEST(MapValues, MasksAreTheirBytes) {
    const Lightmaps maps = test::make_full_lightmaps();
    const auto mask = map_values(maps.view(), LightmapMap::ShadowMask);
    const auto open = map_values(maps.view(), LightmapMap::AmbientOcclusion);
    for (size_t i = 0; i < maps.irradiance.size(); ++i) {
        const float number = static_cast<float>(i);
        EXPECT_EQ(mask->at(i), glm::vec4(1.0f, number / 255.0f, 0.0f, 17.0f / 255.0f));
        EXPECT_EQ(open->at(i), glm::vec4(glm::vec3(3.0f * number / 255.0f), 1.0f));
    }
}

TEST(MapValues, SaysHowToBakeWhatIsMissing) {
    const Lightmaps maps = test::make_black_page(2);
    const auto error_of = [&](LightmapMap map) {
        return error_text(map_values(maps.view(), map).error());
    };
    EXPECT_NE(error_of(LightmapMap::ShadowMask).find("--mixed-lighting shadowmask"),
              std::string::npos);
    EXPECT_NE(error_of(LightmapMap::AmbientOcclusion).find("--ambient-occlusion"),
              std::string::npos);
    EXPECT_NE(error_of(LightmapMap::Direction).find("no directions"), std::string::npos);
    EXPECT_NE(error_of(LightmapMap::MonoSh).find("no directions"), std::string::npos);
}

float luminance(const glm::vec3& light) {
    return glm::dot(kLuminanceWeights, light);
}

glm::vec3 layer_light(const Lightmaps& maps, size_t layer, size_t texel) {
    const auto& rgb = maps.layer_irradiance[layer * maps.irradiance.size() + texel].rgb;
    return maps.layers[layer].scale *
           glm::vec3(float_from_half(rgb[0]), float_from_half(rgb[1]), float_from_half(rgb[2]));
}

TEST(PackedValues, AreTheLuminancesOfLayers) {
    const Lightmaps maps = test::make_full_lightmaps();  // layers sky and light:lamp
    const auto values = packed_values(maps.view(), {"light:lamp^0.5", "sky", "light"});
    ASSERT_TRUE(values) << error_text(values.error());
    EXPECT_FALSE(values->is_fraction);
    EXPECT_EQ(values->channel_count, 3u);
    for (size_t i = 0; i < maps.irradiance.size(); ++i) {
        const float sky = luminance(layer_light(maps, 0, i));
        const float lamp = luminance(layer_light(maps, 1, i));
        const glm::vec4 value = values->at(i);
        EXPECT_NEAR(value.x * value.x, lamp, 1e-4f * lamp);
        EXPECT_NEAR(value.y, sky, 1e-5f * sky);
        EXPECT_NEAR(value.z, sky + lamp, 1e-4f * (sky + lamp));  // the layers are the light
    }
}

TEST(PackedValues, FractionsAreOcclusionsAndShadows) {
    const Lightmaps maps = test::make_full_lightmaps();
    const auto values =
        packed_values(maps.view(), {"sky-occlusion", "shadow:1", "ambient-occlusion", "shadow:3"});
    ASSERT_TRUE(values);
    EXPECT_TRUE(values->is_fraction);
    EXPECT_EQ(values->channel_count, 4u);
    float largest = 0.0f;
    for (size_t i = 0; i < maps.irradiance.size(); ++i) {
        const glm::vec4 value = values->at(i);
        largest = std::max(largest, value.x);
        EXPECT_EQ(value.y, static_cast<float>(i) / 255.0f);
        EXPECT_EQ(value.z, static_cast<float>(3 * i) / 255.0f);
        EXPECT_EQ(value.w, 17.0f / 255.0f);
    }
    EXPECT_NEAR(largest, 1.0f, 1e-6f);
    EXPECT_EQ(packed_values(maps.view(), {"shadow:0"})->at(3), glm::vec4(1, 0, 0, 1));
}

TEST(PackedValues, RefusesWhatIsNotThere) {
    const Lightmaps maps = test::make_full_lightmaps();
    const auto error_of = [&](const std::vector<std::string>& words) {
        const auto values = packed_values(maps.view(), words);
        EXPECT_FALSE(values);
        return values ? "" : error_text(values.error());
    };
    EXPECT_NE(error_of({"sun"}).find("unknown channel \"sun\"; the lightmaps have sky, light:lamp"),
              std::string::npos);
    EXPECT_NE(error_of({"shadow:4"}).find("shadow:0 to shadow:3"), std::string::npos);
    for (const char* word : {"sky^", "sky^x", "sky^-1", "sky^0", "sky^1e9", "sky^nan", "sky^2x"})
        EXPECT_NE(error_of({word}).find("exponent"), std::string::npos) << word;
    EXPECT_NE(error_of({"sky", "sky", "sky", "sky", "sky"}).find("1 to 4"), std::string::npos);
}

}  // namespace
}  // namespace tetralight
