// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_specular_glossiness.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/scene/surface_color.h>
#include "tests/bake/scene/gltf_image_scene.h"

namespace tetralight {
namespace {

using Json = GltfBuilder::Json;

/// The diffuse part of the extension's model: what the specular part leaves.
glm::vec3 left_for_diffuse(glm::vec3 diffuse, glm::vec3 specular) {
    return diffuse * (1.0f - std::max({specular.r, specular.g, specular.b}));
}

/// Light that a bake makes of the extension's model: the diffuse part and half of the specular
/// part times the roughness.
glm::vec3 exact_reflectivity(glm::vec3 diffuse, glm::vec3 specular, float roughness) {
    return left_for_diffuse(diffuse, specular) + specular * (0.5f * roughness);
}

/// Largest difference of a channel between the converted material and the model, for any roughness:
/// it is linear in the roughness.
float largest_error(glm::vec3 diffuse, glm::vec3 specular) {
    const auto converted =
        detail::metallic_color_of_texel(left_for_diffuse(diffuse, specular), specular);
    float largest = 0.0f;
    for (const float roughness : {0.0f, 1.0f}) {
        const glm::vec3 error =
            glm::abs(diffuse_reflectivity(converted.base_color, converted.metallic, roughness) -
                     exact_reflectivity(diffuse, specular, roughness));
        largest = std::max({largest, error.r, error.g, error.b});
    }
    return largest;
}

/// Calls `visit` for the colours of a grid.
template <class Visit>
void for_each_color(const std::vector<float>& values, const Visit& visit) {
    for (const float r : values) {
        for (const float g : values) {
            for (const float b : values) visit(glm::vec3(r, g, b));
        }
    }
}

TEST(MetallicColor, DielectricsAreExact) {
    for_each_color({0.0f, 0.025f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}, [](glm::vec3 diffuse) {
        EXPECT_LT(largest_error(diffuse, glm::vec3(0.04f)), 1e-5f)
            << diffuse.r << ' ' << diffuse.g << ' ' << diffuse.b;
    });
}

TEST(MetallicColor, MetalsAreExact) {
    for_each_color({0.12f, 0.25f, 0.5f, 0.75f, 1.0f}, [](glm::vec3 specular) {
        EXPECT_LT(largest_error(glm::vec3(0.0f), specular), 1e-5f)
            << specular.r << ' ' << specular.g << ' ' << specular.b;
    });
}

TEST(MetallicColor, GreyIsExact) {
    for (int i = 0; i <= 25 * 25; ++i) {
        const float diffuse = static_cast<float>(i % 26) / 25.0f;
        const float specular = 0.12f + 0.88f * static_cast<float>(i / 26) / 25.0f;
        EXPECT_LT(largest_error(glm::vec3(diffuse), glm::vec3(specular)), 1e-5f)
            << diffuse << ' ' << specular;
    }
}

TEST(MetallicColor, SpecularPartsOfOtherDielectricsAreNear) {
    for (float specular = 0.04f; specular < 0.12f; specular += 0.005f) {
        for (const float diffuse : {0.0f, 0.02f, 0.5f, 1.0f}) {
            EXPECT_LT(largest_error(glm::vec3(diffuse), glm::vec3(specular)), 0.0201f)
                << diffuse << ' ' << specular;
        }
    }
}

/// Light of a surface halfway between two texels, which are filtered as textures are: base colours
/// and factors apart.
float filtered_reflectivity(glm::vec3 diffuse_a, glm::vec3 diffuse_b, glm::vec3 specular) {
    const auto a = detail::metallic_color_of_texel(left_for_diffuse(diffuse_a, specular), specular);
    const auto b = detail::metallic_color_of_texel(left_for_diffuse(diffuse_b, specular), specular);
    return diffuse_reflectivity(0.5f * (a.base_color + b.base_color),
                                0.5f * (a.metallic + b.metallic), 1.0f)
        .r;
}

TEST(MetallicColor, BlackAndWhiteTexelsOfADielectricAreGreyBetween) {
    for (const float specular : {0.02f, 0.04f, 0.06f, 0.08f}) {
        const float exact = exact_reflectivity(glm::vec3(0.5f), glm::vec3(specular), 1.0f).r;
        EXPECT_NEAR(filtered_reflectivity(glm::vec3(0.0f), glm::vec3(1.0f), glm::vec3(specular)),
                    exact, 0.021f)
            << specular;
    }
}

TEST(MetallicColor, BlackTexelsOfDielectricsAreNoMetals) {
    for (const float specular : {0.03f, 0.04f, 0.05f, 0.08f}) {
        EXPECT_EQ(detail::metallic_color_of_texel(glm::vec3(0.0f), glm::vec3(specular)).metallic,
                  0.0f)
            << specular;
    }
}

TEST(MetallicColor, DarkSpecularPartsBecomeFourPercent) {
    // The diffuse part changes from 1 − specular to 0.96, or the specular part to 0.04.
    for (const float specular : {0.0f, 0.01f, 0.03f}) {
        for (const float diffuse : {0.0f, 0.5f, 1.0f}) {
            EXPECT_LE(largest_error(glm::vec3(diffuse), glm::vec3(specular)),
                      0.04f - specular + 1e-6f);
        }
    }
}

TEST(MetallicColor, ColorsBesideBrightSpecularPartsAreNear) {
    float largest = 0.0f;
    for_each_color({0.0f, 0.25f, 0.5f, 0.75f, 1.0f}, [&](glm::vec3 diffuse) {
        for_each_color({0.0f, 0.04f, 0.25f, 0.5f, 0.75f, 1.0f}, [&](glm::vec3 specular) {
            largest = std::max(largest, largest_error(diffuse, specular));
        });
    });
    EXPECT_LT(largest, 0.27f);  // blue beside a yellow specular part
    EXPECT_GT(largest, 0.25f);  // the bound that the documentation has is no guess
}

/// A material of the extension.
Json specular_glossiness(Json members) {
    return {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", std::move(members)}}}};
}

TEST(GltfSpecularGlossiness, ReplacesTheMetallicRoughnessPart) {
    Json material = specular_glossiness({{"diffuseFactor", {0.5, 0.25, 0.75, 0.5}},
                                         {"specularFactor", {0.04, 0.04, 0.04}},
                                         {"glossinessFactor", 0.75}});
    // The part has a factor that is out of range and an image that is missing.
    material["pbrMetallicRoughness"] = {{"metallicFactor", 3},
                                        {"baseColorTexture", {{"index", 0}}}};
    GltfImageScene gltf;
    gltf.json["images"] = {{{"uri", "missing.png"}}};
    gltf.json["textures"] = {{{"source", 0}}};
    gltf.add_painted(material);
    gltf.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const Scene scene = gltf.scene();
    const Material& read = scene.materials.at(0);
    EXPECT_LT(glm::distance(read.base_color, glm::vec4(0.5f, 0.25f, 0.75f, 0.5f)), 1e-5f);
    EXPECT_NEAR(read.metallic, 0.0f, 1e-5f);
    EXPECT_EQ(read.roughness, 0.25f);
    EXPECT_TRUE(scene.textures.empty());
}

TEST(GltfSpecularGlossiness, UnlitMaterialsShowTheirBaseColor) {
    Json material = specular_glossiness({{"diffuseFactor", {0, 0, 0, 1}}});
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}};
    GltfImageScene gltf;
    gltf.add_painted(material);
    EXPECT_EQ(gltf.scene().materials.at(0).base_color, glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
}

/// The surface of a texel, by the coordinates of its centre.
struct TexelSurface {
    Scene scene;

    glm::vec3 reflectivity(glm::vec2 first_uv, glm::vec2 second_uv = glm::vec2(0.0f)) {
        scene.meshes[0].uvs[0].assign(3, first_uv);
        scene.meshes[0].uvs[1].assign(3, second_uv);
        return diffuse_reflectivity(scene, mesh_point(scene.meshes[0], 0, {0.25f, 0.5f}));
    }
};

/// Grey of a code, linear.
float grey(uint8_t code) {
    return linear_from_srgb8(code);
}

TEST(GltfSpecularGlossiness, TexturesAreConvertedTexelByTexel) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{200, 200, 200, 64}, {100, 100, 100, 255}}});
    gltf.add_image({2, 1, {{188, 188, 188, 51}, {90, 90, 90, 255}}});
    gltf.add_painted(specular_glossiness(
        {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}}));
    TexelSurface surface{gltf.scene()};
    ASSERT_EQ(surface.scene.textures.size(), 2u);
    const auto expect = [&](float u, uint8_t diffuse, uint8_t specular, float roughness) {
        const float exact =
            exact_reflectivity(glm::vec3(grey(diffuse)), glm::vec3(grey(specular)), roughness).r;
        // Codes of 8 bits are off by 0.004 of a colour, and by 0.002 of a factor.
        EXPECT_NEAR(surface.reflectivity({u, 0.5f}).r, exact, 0.005f) << u;
    };
    expect(0.25f, 200, 188, 0.8f);
    expect(0.75f, 100, 90, 0.0f);
    EXPECT_EQ(surface.scene.textures[0].image.pixels[0][3], 64);
}

TEST(GltfSpecularGlossiness, TexturesOfOtherSizesAreResampledToTheLarger) {
    GltfImageScene gltf;
    gltf.add_image({1, 2, {{200, 200, 200, 255}, {100, 100, 100, 255}}});
    gltf.add_image(
        {4, 1, {{188, 188, 188, 0}, {188, 188, 188, 0}, {100, 100, 100, 0}, {100, 100, 100, 0}}});
    gltf.add_painted(specular_glossiness(
        {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}}));
    TexelSurface surface{gltf.scene()};
    ASSERT_EQ(surface.scene.textures.size(), 2u);
    for (const Texture& texture : surface.scene.textures) {
        EXPECT_EQ(texture.image.width, 4u);
        EXPECT_EQ(texture.image.height, 2u);
    }
    for (int i = 0; i < 8; ++i) {
        const glm::vec2 uv((static_cast<float>(i % 4) + 0.5f) / 4.0f, i < 4 ? 0.25f : 0.75f);
        const glm::vec3 diffuse(grey(i < 4 ? 200 : 100)), specular(grey(i % 4 < 2 ? 188 : 100));
        EXPECT_NEAR(surface.reflectivity(uv).r, exact_reflectivity(diffuse, specular, 1.0f).r,
                    0.005f)
            << i;
    }
}

TEST(GltfSpecularGlossiness, LongTexturesAcrossAndDownDoNotMultiply) {
    GltfImageScene gltf;
    gltf.add_image({64, 1, std::vector<std::array<uint8_t, 4>>(64, {200, 100, 50, 255})});
    gltf.add_image({1, 32, std::vector<std::array<uint8_t, 4>>(32, {188, 188, 188, 0})});
    gltf.add_painted(specular_glossiness(
        {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}}));
    EXPECT_TRUE(gltf.scene().textures.empty());  // all texels are alike
    const std::vector<Texture> textures = {{"a", {64, 1, {}}}, {"b", {1, 32, {}}}};
    const std::array<TextureUse, 2> uses = {TextureUse{0}, TextureUse{1}};
    const detail::TexelGrid grid(textures, uses[0], uses);
    EXPECT_EQ(grid.size().width, 64u);
    EXPECT_EQ(grid.size().height, 1u);
}

TEST(GltfSpecularGlossiness, TexturesOfOtherCoordinatesCountByTheirMean) {
    // A diffuse part of the first coordinates, and a glossiness of the second ones.
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{200, 200, 200, 255}, {100, 100, 100, 255}}});
    gltf.add_image({1, 2, {{255, 255, 255, 0}, {255, 255, 255, 255}}});
    gltf.add_painted(
        specular_glossiness({{"diffuseTexture", {{"index", 0}}},
                             {"specularFactor", {0.04, 0.04, 0.04}},
                             {"specularGlossinessTexture", {{"index", 1}, {"texCoord", 1}}}}));
    TexelSurface surface{gltf.scene()};
    EXPECT_EQ(surface.scene.materials[0].base_color_texture.uv_set, 0u);
    EXPECT_EQ(surface.scene.materials[0].metallic_roughness_texture.uv_set, 1u);
    for (const float u : {0.25f, 0.75f}) {
        for (const float v : {0.25f, 0.75f}) {
            const glm::vec3 exact = exact_reflectivity(glm::vec3(grey(u < 0.5f ? 200 : 100)),
                                                       glm::vec3(0.04f), v < 0.5f ? 1.0f : 0.0f);
            EXPECT_NEAR(surface.reflectivity({u, 0.5f}, {0.5f, v}).r, exact.r, 0.005f)
                << u << ' ' << v;
        }
    }
}

TEST(GltfSpecularGlossiness, FactorsThatAreTheSameEverywhereNeedNoTexture) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{200, 200, 200, 64}, {100, 100, 100, 255}}});
    gltf.add_painted(specular_glossiness({{"diffuseTexture", {{"index", 0}}},
                                          {"specularFactor", {0, 0, 0}},
                                          {"glossinessFactor", 0.7}}));
    const Scene scene = gltf.scene();
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials.at(0).metallic, 0.0f);
    EXPECT_FLOAT_EQ(scene.materials.at(0).roughness, 0.3f);
}

TEST(GltfSpecularGlossiness, MaterialsShareWhatTheyConvertAlike) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{200, 200, 200, 64}, {100, 100, 100, 255}}});
    gltf.add_image({2, 1, {{188, 188, 188, 51}, {90, 90, 90, 255}}});
    const Json material = specular_glossiness(
        {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}});
    gltf.add_painted(material);
    gltf.add_painted(material);
    Json darker = material;
    darker["extensions"]["KHR_materials_pbrSpecularGlossiness"]["diffuseFactor"] = {0.5, 1, 1, 1};
    gltf.add_painted(darker);
    Json plain = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
    gltf.add_painted(plain);
    const Scene scene = gltf.scene();
    ASSERT_EQ(scene.materials.size(), 4u);
    EXPECT_EQ(scene.materials[0].base_color_texture, scene.materials[1].base_color_texture);
    EXPECT_EQ(scene.materials[0].metallic_roughness_texture,
              scene.materials[1].metallic_roughness_texture);
    EXPECT_NE(scene.materials[0].base_color_texture, scene.materials[2].base_color_texture);
    // Two of each conversion and the image that the last material shows as it is.
    EXPECT_EQ(scene.textures.size(), 5u);
    const auto& shown = scene.textures.at(scene.materials[3].base_color_texture.texture);
    EXPECT_EQ(shown.image.pixels[0], (std::array<uint8_t, 4>{200, 200, 200, 64}));
}

TEST(GltfSpecularGlossiness, FactorsOutOfRangeAreErrors) {
    for (const auto& [member, value] : {std::pair<const char*, Json>{"diffuseFactor", {0, 2, 0, 1}},
                                        {"specularFactor", {0, 0, 2}},
                                        {"glossinessFactor", 2}}) {
        GltfImageScene gltf;
        gltf.add_painted(specular_glossiness({{member, value}}));
        EXPECT_EQ(gltf.error(),
                  std::string("scene.glb: material 0: ") + member + " 2 is not in 0 to 1");
        const auto read = gltf.read();
        ASSERT_FALSE(read);
        EXPECT_EQ(
            read.error().field,
            std::string("materials[0].extensions.KHR_materials_pbrSpecularGlossiness.") + member);
    }
}

}  // namespace
}  // namespace tetralight
