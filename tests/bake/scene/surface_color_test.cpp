// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/surface_color.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace tetralight {
namespace {

float reflectivity(float base, float metallic, float roughness) {
    return diffuse_reflectivity(glm::vec3(base), metallic, roughness).x;
}

void expect_color(glm::vec3 actual, glm::vec3 expected) {
    EXPECT_LT(glm::distance(actual, expected), 1e-6f) << actual.x << ' ' << expected.x;
}

/// One triangle whose texture coordinates are all (1/2, 1/2), and one texel that its uses show.
struct OneTexel {
    Scene scene;

    explicit OneTexel(std::array<uint8_t, 4> texel) {
        scene.textures.push_back({"texel", Image8{1, 1, {texel}}});
        scene.materials.resize(1);
        scene.meshes.resize(1);
        scene.meshes[0].material = 0;
        scene.meshes[0].positions.resize(3);
        scene.meshes[0].uvs[0].resize(3, glm::vec2(0.5f));
        scene.meshes[0].indices = {0, 1, 2};
    }

    Material& material() { return scene.materials[0]; }

    [[nodiscard]] MeshPoint point() const { return mesh_point(scene.meshes[0], 0, {0.25f, 0.5f}); }
};

TEST(DiffuseReflectivity, DielectricsMirrorFourPercent) {
    EXPECT_FLOAT_EQ(reflectivity(0.5f, 0.0f, 0.0f), 0.48f);
    // Rough ones give half of the four per cent back.
    EXPECT_FLOAT_EQ(reflectivity(0.5f, 0.0f, 1.0f), 0.48f + 0.02f);
    EXPECT_FLOAT_EQ(reflectivity(0.0f, 0.0f, 1.0f), 0.02f);
}

TEST(DiffuseReflectivity, MetalsPassHalfOfTheirColorTimesRoughnessOn) {
    EXPECT_FLOAT_EQ(reflectivity(0.8f, 1.0f, 0.0f), 0.0f);
    EXPECT_FLOAT_EQ(reflectivity(0.8f, 1.0f, 0.5f), 0.2f);
    EXPECT_FLOAT_EQ(reflectivity(0.8f, 1.0f, 1.0f), 0.4f);
}

TEST(DiffuseReflectivity, HalfMetalsAreHalfWayBetween) {
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
        const float middle =
            0.5f * (reflectivity(0.6f, 0.0f, roughness) + reflectivity(0.6f, 1.0f, roughness));
        EXPECT_FLOAT_EQ(reflectivity(0.6f, 0.5f, roughness), middle);
    }
}

TEST(DiffuseReflectivity, IsAffineInTheBaseColor) {
    for (int i = 0; i < 16; ++i) {
        const float metallic = static_cast<float>(i % 4) / 3.0f;
        const float roughness = static_cast<float>(i / 4) / 3.0f;
        const ReflectivityTerms terms = reflectivity_terms(metallic, roughness);
        for (const float base : {0.0f, 0.3f, 1.0f}) {
            EXPECT_NEAR(terms.per_color * base + terms.colorless,
                        reflectivity(base, metallic, roughness), 1e-6f);
        }
    }
}

TEST(DiffuseReflectivity, NothingGivesBackAllThatArrives) {
    for (int i = 0; i <= 1000; ++i) {
        const float base = static_cast<float>(i % 11) / 10.0f;
        const float metallic = static_cast<float>(i / 11 % 11) / 10.0f;
        const float roughness = static_cast<float>(i / 121) / 10.0f;
        EXPECT_GE(reflectivity(base, metallic, roughness), 0.0f);
        EXPECT_LE(reflectivity(base, metallic, roughness), 0.98001f);
    }
}

TEST(DiffuseReflectivity, GreenScalesRoughnessAndBlueMetallicLinearly) {
    // 51 / 255 = 0.2 and 102 / 255 = 0.4; red and alpha do not count.
    OneTexel texel({17, 51, 102, 3});
    texel.material().base_color = glm::vec4(0.5f, 0.25f, 1.0f, 1.0f);
    texel.material().metallic = 0.5f;
    texel.material().roughness = 1.0f;
    texel.material().metallic_roughness_texture.texture = 0;
    expect_color(diffuse_reflectivity(texel.scene, texel.point()),
                 diffuse_reflectivity({0.5f, 0.25f, 1.0f}, 0.2f, 0.2f));
}

TEST(DiffuseReflectivity, BaseColorIsFactorTimesDecodedTexture) {
    OneTexel texel({255, 0, 255, 102});
    texel.material().base_color = {0.5f, 0.5f, 0.25f, 0.5f};
    texel.material().base_color_texture.texture = 0;
    const glm::vec4 color = base_color(texel.scene, texel.point());
    expect_color(glm::vec3(color), {0.5f, 0.0f, 0.25f});
    EXPECT_FLOAT_EQ(color.a, 0.2f);  // 0.5 · 102/255
}

TEST(DiffuseReflectivity, VertexColorsScaleBaseColorAndAlpha) {
    OneTexel texel({255, 255, 255, 255});
    texel.material().base_color = {0.5f, 1.0f, 1.0f, 0.5f};
    // Corners with the weights 1/4, 1/4 and 1/2.
    texel.scene.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0}};
    const glm::vec4 color = base_color(texel.scene, texel.point());
    expect_color(glm::vec3(color), {0.125f, 0.25f, 0.5f});
    EXPECT_FLOAT_EQ(color.a, 0.25f);
}

TEST(EmittedRadiance, VertexColorsTintUnlitMaterialsAlone) {
    OneTexel texel({255, 255, 255, 255});
    texel.scene.meshes[0].colors.assign(3, {0.5f, 0.25f, 0.0f, 1.0f});
    texel.material().emission = {4, 4, 4};
    expect_color(emitted_radiance(texel.scene, texel.point()), {4, 4, 4});
    texel.material().is_unlit = true;
    expect_color(emitted_radiance(texel.scene, texel.point()), {0.5f, 0.25f, 0.0f});
}

TEST(EmittedRadiance, IsFactorTimesTexture) {
    OneTexel texel({255, 0, 255, 255});
    texel.material().emission = {8, 4, 2};
    texel.material().emission_texture.texture = 0;
    expect_color(emitted_radiance(texel.scene, texel.point()), {8, 0, 2});
}

TEST(EmittedRadiance, UnlitMaterialsShowTheirBaseColorAndReflectNothing) {
    OneTexel texel({255, 0, 255, 255});
    Material& material = texel.material();
    material.is_unlit = true;
    material.base_color = {0.5f, 0.5f, 0.25f, 1.0f};
    material.base_color_texture.texture = 0;
    material.emission = {8, 4, 2};  // KHR_materials_unlit: all but the base colour is left out
    expect_color(emitted_radiance(texel.scene, texel.point()), {0.5f, 0.0f, 0.25f});
    EXPECT_EQ(diffuse_reflectivity(texel.scene, texel.point()), glm::vec3(0.0f));
}

TEST(AdjustedAlbedo, BoostIsARootThatKeepsBlackAndWhite) {
    const SurfaceSettings settings{2.0f, 1.0f};
    expect_color(adjusted_albedo({0.25f, 0.0f, 1.0f}, settings), {0.5f, 0.0f, 1.0f});
    expect_color(adjusted_albedo({0.25f, 0.5f, 0.75f}, {}), {0.25f, 0.5f, 0.75f});
}

TEST(AdjustedAlbedo, IsLimitedAfterTheBoost) {
    expect_color(adjusted_albedo({0.25f, 0.81f, 1.0f}, {2.0f, 0.6f}), {0.5f, 0.6f, 0.6f});
}

TEST(AdjustedAlbedo, NeverAboveOne) {
    expect_color(adjusted_albedo({1.5f, 0.5f, 0.0f}, {}), {1.0f, 0.5f, 0.0f});
}

}  // namespace
}  // namespace tetralight
