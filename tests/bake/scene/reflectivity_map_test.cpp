// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/reflectivity_map.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include <tetralight/bake/image/srgb.h>

namespace tetralight {
namespace {

/// Relative error of rounding to a half float.
constexpr float kHalfError = 0x1p-11f;

Texture random_texture(uint32_t width, uint32_t height, uint32_t seed) {
    std::mt19937 engine(seed);
    Texture texture{"random", Image8{width, height, {}}};
    for (uint32_t i = 0; i < width * height; ++i) {
        const auto bits = static_cast<uint32_t>(engine());
        texture.image.pixels.push_back({static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8),
                                        static_cast<uint8_t>(bits >> 16),
                                        static_cast<uint8_t>(bits >> 24)});
    }
    return texture;
}

/// A scene with one material of a base color texture and no specular reflection.
Scene textured(Texture texture) {
    Scene scene;
    scene.textures.push_back(std::move(texture));
    Material material;
    material.metallic = 0.0f;
    material.roughness = 0.0f;
    material.base_color_texture.texture = 0;
    scene.materials.push_back(material);
    return scene;
}

ReflectivityMap map_of(const Scene& scene, const SurfaceSettings& settings = {}) {
    return make_reflectivity_map(scene, scene.materials[0], settings);
}

glm::vec3 decoded(const std::array<uint8_t, 4>& code) {
    return {linear_from_srgb8(code[0]), linear_from_srgb8(code[1]), linear_from_srgb8(code[2])};
}

/// The mean of lookups at places that lie evenly in the texels.
glm::vec3 mean_of_lookups(const ReflectivityMap& map, size_t level) {
    const uint32_t columns = 4 * map.levels[level].width, rows = 4 * map.levels[level].height;
    glm::dvec3 sum(0.0);
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(columns, rows);
            sum += glm::dvec3(sample_reflectivity(map, level, uv));
        }
    }
    return glm::vec3(sum / (static_cast<double>(columns) * rows));
}

TEST(ReflectivityMap, EveryLevelHasTheMeanOfTheDecodedTexels) {
    for (const auto& [width, height] : {std::pair(64u, 64u), std::pair(1u, 1u), std::pair(5u, 3u),
                                        std::pair(37u, 130u), std::pair(1u, 77u)}) {
        Scene scene = textured(random_texture(width, height, width));
        glm::dvec3 sum(0.0);
        for (const auto& code : scene.textures[0].image.pixels) sum += glm::dvec3(decoded(code));
        const glm::vec3 mean = 0.96f * glm::vec3(sum / (static_cast<double>(width) * height));
        for (const auto wrap :
             {TextureWrap::Repeat, TextureWrap::MirroredRepeat, TextureWrap::ClampToEdge}) {
            scene.textures[0].wrap_u = scene.textures[0].wrap_v = wrap;
            const ReflectivityMap map = map_of(scene);
            ASSERT_EQ(map.levels.size(), 3u);
            for (size_t level = 0; level < 3; ++level) {
                EXPECT_LT(glm::distance(mean_of_lookups(map, level), mean),
                          kHalfError * glm::length(mean))
                    << width << " x " << height << " level " << level;
            }
        }
    }
}

TEST(ReflectivityMap, LevelsAreHalvedAndRoundedUp) {
    const ReflectivityMap map = map_of(textured(random_texture(37, 6, 1)));
    EXPECT_EQ(map.finest_texels, 2.0f);
    EXPECT_EQ(map.levels[0].width, 19u);
    EXPECT_EQ(map.levels[0].height, 3u);
    EXPECT_EQ(map.levels[1].width, 10u);
    EXPECT_EQ(map.levels[1].height, 2u);
    EXPECT_EQ(map.levels[2].width, 5u);
    EXPECT_EQ(map.levels[2].height, 1u);
}

TEST(ReflectivityMap, FootprintChoosesTheCoarsestLevelThatIsNotCoarser) {
    Scene scene = textured(random_texture(64, 64, 1));
    // The mesh repeats the texture twice along u: 128 × 64 texels a unit, 90.5 by their density.
    scene.materials[0].base_color_texture.image_from_mesh[0].x = 2.0f;
    const ReflectivityMap map = map_of(scene);
    const float texel = 1.0f / std::sqrt(128.0f * 64.0f);
    const glm::vec2 mesh_uv(0.2f, 0.3f), image_uv(0.4f, 0.3f);
    EXPECT_FALSE(filtered_reflectivity(map, mesh_uv, 0.0f));
    EXPECT_FALSE(filtered_reflectivity(map, mesh_uv, 1.99f * texel));
    EXPECT_FALSE(filtered_reflectivity(map, mesh_uv, std::nanf("")));
    const std::pair<float, size_t> levels[] = {{2.01f, 0}, {3.99f, 0}, {4.01f, 1},
                                               {7.99f, 1}, {8.01f, 2}, {1e30f, 2}};
    for (const auto& [texels, level] : levels) {
        EXPECT_EQ(filtered_reflectivity(map, mesh_uv, texels * texel),
                  sample_reflectivity(map, level, image_uv))
            << texels;
    }
}

TEST(ReflectivityMap, IsAffineInTheVertexColor) {
    Scene scene = textured(random_texture(1, 1, 3));
    scene.textures.push_back(random_texture(1, 1, 4));
    Material& material = scene.materials[0];
    material.base_color = {0.9f, 0.5f, 0.7f, 1.0f};
    material.metallic = 0.8f;
    material.roughness = 0.6f;
    material.metallic_roughness_texture.texture = 1;
    const glm::vec4 value = sample_reflectivity(map_of(scene), 0, glm::vec2(0.3f));
    const auto& factors = scene.textures[1].image.pixels[0];
    for (const glm::vec3 color : {glm::vec3(1.0f), glm::vec3(0.25f, 0.5f, 0.0f)}) {
        const glm::vec3 expected = diffuse_reflectivity(
            color * glm::vec3(material.base_color) * decoded(scene.textures[0].image.pixels[0]),
            0.8f * static_cast<float>(factors[2]) / 255.0f,
            0.6f * static_cast<float>(factors[1]) / 255.0f);
        EXPECT_LT(glm::distance(color * glm::vec3(value) + value.a, expected), 2.0f * kHalfError);
    }
}

TEST(ReflectivityMap, AveragesProductsOfTwoTexturesAndNotTheirMeans) {
    // Polished: white dielectrics and black metals reflect 0.96 and 0. The product of the mean
    // color and the mean of 1 − metallic would be 0.25 · 0.96.
    Scene scene = textured({"color", Image8{2, 1, {{255, 255, 255, 255}, {0, 0, 0, 255}}}});
    scene.textures.push_back({"metallic", Image8{2, 1, {{0, 0, 0, 255}, {0, 0, 255, 255}}}});
    scene.materials[0].metallic = 1.0f;
    scene.materials[0].metallic_roughness_texture.texture = 1;
    EXPECT_NEAR(sample_reflectivity(map_of(scene), 0, glm::vec2(0.5f)).x, 0.48f, kHalfError);
}

TEST(ReflectivityMap, TexturesOfDifferentSizesAreCombined) {
    Scene scene = textured(random_texture(16, 8, 5));
    scene.textures.push_back({"metallic", Image8{1, 1, {{0, 0, 51, 255}}}});
    scene.materials[0].metallic = 1.0f;
    scene.materials[0].metallic_roughness_texture.texture = 1;
    const ReflectivityMap map = map_of(scene);
    scene.materials[0].metallic = 0.2f;
    scene.materials[0].metallic_roughness_texture.texture = kNoIndex;
    EXPECT_EQ(map.levels[0].width, 8u);
    EXPECT_LT(glm::distance(mean_of_lookups(map, 0), mean_of_lookups(map_of(scene), 0)), 1e-3f);
}

TEST(ReflectivityMap, HiddenTexelsDoNotCount) {
    Texture texture{"leaves", Image8{8, 8, {}}};
    for (int i = 0; i < 64; ++i) {
        const bool is_visible = i % 8 < 3 && i / 8 < 3;
        texture.image.pixels.push_back(is_visible ? std::array<uint8_t, 4>{188, 188, 188, 200}
                                                  : std::array<uint8_t, 4>{255, 255, 255, 100});
    }
    Scene scene = textured(texture);
    const float visible = 0.96f * linear_from_srgb8(188);
    scene.materials[0].alpha_mode = AlphaMode::Mask;
    const ReflectivityMap mask = map_of(scene);
    scene.materials[0].alpha_mode = AlphaMode::Blend;
    scene.materials[0].base_color.a = 0.5f;
    const ReflectivityMap blend = map_of(scene);
    for (size_t level = 0; level < 3; ++level) {
        EXPECT_NEAR(mean_of_lookups(mask, level).x, visible, kHalfError);
    }
    // 9 texels with the opacity 200/510, and 55 with 100/510.
    const float mean = (9 * 2 * visible + 55 * 0.96f) / (9 * 2 + 55);
    EXPECT_NEAR(sample_reflectivity(blend, 2, glm::vec2(0.5f)).x, mean, kHalfError);
}

TEST(ReflectivityMap, SettingsApplyToTexelsBeforeTheMean) {
    const Scene scene = textured({"pair", Image8{2, 1, {{255, 255, 255, 255}, {0, 0, 0, 255}}}});
    const ReflectivityMap map = map_of(scene, {.albedo_boost = 2.0f, .max_albedo = 0.5f});
    EXPECT_NEAR(sample_reflectivity(map, 0, glm::vec2(0.5f)).x, 0.25f, kHalfError);
}

TEST(ReflectivityMap, MaterialsWithoutTexturesAreConstant) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].base_color = {0.5f, 0.25f, 1.0f, 1.0f};
    scene.materials[0].metallic = 0.3f;
    const ReflectivityMap map = map_of(scene);
    EXPECT_TRUE(map.levels.empty());
    const auto value = filtered_reflectivity(map, glm::vec2(0.0f), 0.0f);
    ASSERT_TRUE(value);
    EXPECT_LT(glm::distance(glm::vec3(*value) + value->a,
                            diffuse_reflectivity({0.5f, 0.25f, 1.0f}, 0.3f, 1.0f)),
              1e-6f);
}

TEST(ReflectivityMap, ExistsWhereOneLookupGivesTheReflectivity) {
    Scene scene = textured(random_texture(2, 2, 1));
    scene.textures.push_back(random_texture(2, 2, 2));
    Material& material = scene.materials[0];
    EXPECT_TRUE(has_reflectivity_map(scene, material, {}, true));
    EXPECT_TRUE(has_reflectivity_map(scene, material, {.max_albedo = 0.5f}, false));
    EXPECT_FALSE(has_reflectivity_map(scene, material, {.max_albedo = 0.5f}, true));
    material.metallic_roughness_texture.texture = 1;
    EXPECT_TRUE(has_reflectivity_map(scene, material, {}, true));
    material.metallic_roughness_texture.uv_set = 1;
    EXPECT_FALSE(has_reflectivity_map(scene, material, {}, true));
    material.metallic_roughness_texture.uv_set = 0;
    scene.textures[1].wrap_v = TextureWrap::ClampToEdge;
    EXPECT_FALSE(has_reflectivity_map(scene, material, {}, true));
    material.metallic_roughness_texture = {};
    material.is_unlit = true;
    EXPECT_FALSE(has_reflectivity_map(scene, material, {}, true));
}

TEST(ReflectivityMap, MemoryIsBounded) {
    Scene scene = textured({"large", Image8{2048, 2048, {}}});
    const uint64_t bytes = reflectivity_map_bytes(scene, scene.materials[0]);
    EXPECT_EQ(bytes, 8u * (1024 * 1024 + 512 * 512 + 256 * 256));
    for (const uint32_t size : {4096u, 8192u, 100'000u}) {
        scene.textures[0].image = {size, size, {}};
        EXPECT_LE(reflectivity_map_bytes(scene, scene.materials[0]), bytes);
    }
    scene.textures[0].image = {9, 5, std::vector<std::array<uint8_t, 4>>(45)};
    uint64_t kept = 0;
    for (const auto& level : map_of(scene).levels)
        kept += sizeof(level.texels[0]) * level.texels.size();
    EXPECT_EQ(reflectivity_map_bytes(scene, scene.materials[0]), kept);
}

}  // namespace
}  // namespace tetralight
