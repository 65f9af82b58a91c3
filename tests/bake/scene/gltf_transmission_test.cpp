// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_transmission.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/scene/surface_color.h>
#include "tests/bake/scene/gltf_image_scene.h"

namespace tetralight {
namespace {

using Json = GltfBuilder::Json;

constexpr glm::vec3 kLuminance(0.2126f, 0.7152f, 0.0722f);

/// The fraction of light that the extension lets through: of the light that is not mirrored, and of
/// the dielectric part, times the base colour.
glm::vec3 exact_transmission(const detail::MetallicColor& color, float transmission) {
    return 0.96f * (1.0f - color.metallic) * transmission * color.base_color;
}

/// The fraction that a bake reflects: less of the diffuse part, and all of the specular part.
glm::vec3 exact_reflection(const detail::MetallicColor& color, float transmission,
                           float roughness) {
    const glm::vec3 specular = glm::mix(glm::vec3(0.04f), color.base_color, color.metallic);
    return 0.96f * (1.0f - color.metallic) * (1.0f - transmission) * color.base_color +
           specular * (0.5f * roughness);
}

/// Largest error of the reflection of a channel, for any roughness.
float reflection_error(const detail::MetallicColor& color, float transmission) {
    const detail::PartlyCovering surface = detail::partly_covering(color, transmission);
    float largest = 0.0f;
    for (const float roughness : {0.0f, 1.0f}) {
        const glm::vec3 error =
            glm::abs(surface.opacity * diffuse_reflectivity(surface.color.base_color,
                                                            surface.color.metallic, roughness) -
                     exact_reflection(color, transmission, roughness));
        largest = std::max({largest, error.r, error.g, error.b});
    }
    return largest;
}

/// Calls `visit(color, transmission)` for a grid of surfaces.
template <class Visit>
void for_each_glass(const Visit& visit) {
    for (int i = 0; i < 5 * 5 * 5 * 3 * 21; ++i) {
        const auto step = [](int index) { return static_cast<float>(index) / 4.0f; };
        const glm::vec3 base(step(i % 5), step(i / 5 % 5), step(i / 25 % 5));
        visit({base, step(i / 125 % 3)}, static_cast<float>(i / 375) / 20.0f);
    }
}

TEST(PartlyCovering, TransmitsTheLuminanceOfWhatTheExtensionLetsThrough) {
    for_each_glass([](const detail::MetallicColor& color, float transmission) {
        const detail::PartlyCovering surface = detail::partly_covering(color, transmission);
        EXPECT_NEAR(1.0f - surface.opacity,
                    glm::dot(kLuminance, exact_transmission(color, transmission)), 1e-6f);
    });
}

TEST(PartlyCovering, ReflectsWhatTheExtensionLeaves) {
    float largest = 0.0f;
    for_each_glass([&](const detail::MetallicColor& color, float transmission) {
        const glm::vec3& base = color.base_color;
        const float error = reflection_error(color, transmission);
        if (base.r == base.g && base.g == base.b) {
            EXPECT_LT(error, 1e-5f) << base.r << ' ' << color.metallic << ' ' << transmission;
        }
        largest = std::max(largest, error);
    });
    EXPECT_LT(largest, 0.02f);
}

TEST(PartlyCovering, MirrorsFourPercentInPictures) {
    const auto surface = detail::partly_covering({glm::vec3(1.0f), 0.0f}, 1.0f);
    const glm::vec3 f0 =
        glm::mix(glm::vec3(0.04f), surface.color.base_color, surface.color.metallic);
    EXPECT_NEAR(surface.opacity * f0.r, 0.04f, 1e-6f);
}

TEST(PartlyCovering, NeitherMetalsNorOpaqueSurfacesChange) {
    for (const auto& [metallic, transmission] : {std::pair{1.0f, 1.0f}, {0.25f, 0.0f}}) {
        const auto surface =
            detail::partly_covering({{0.25f, 0.5f, 0.75f}, metallic}, transmission);
        EXPECT_EQ(surface.color.base_color, glm::vec3(0.25f, 0.5f, 0.75f));
        EXPECT_EQ(surface.color.metallic, metallic);
        EXPECT_EQ(surface.opacity, 1.0f);
    }
}

/// A dielectric of this colour that lets light through.
Json glass(Json base_color, Json transmission) {
    return {{"pbrMetallicRoughness",
             {{"baseColorFactor", std::move(base_color)},
              {"metallicFactor", 0},
              {"roughnessFactor", 0.5}}},
            {"extensions", {{"KHR_materials_transmission", std::move(transmission)}}}};
}

Material read_one(Json material) {
    GltfImageScene gltf;
    gltf.add_painted(std::move(material));
    const Scene scene = gltf.scene();
    return scene.materials.empty() ? Material() : scene.materials[0];
}

TEST(GltfTransmission, GlassIsBlended) {
    GltfImageScene gltf;
    gltf.add_painted(glass({0.5, 0.5, 0.5, 0.25}, {{"transmissionFactor", 0.5}}));
    gltf.json["extensionsRequired"] = {"KHR_materials_transmission"};
    const Material pane = gltf.scene().materials.at(0);
    EXPECT_EQ(pane.alpha_mode, AlphaMode::Blend);
    EXPECT_FLOAT_EQ(pane.base_color.a, 1.0f - 0.96f * 0.25f);  // opaque: alpha does not count
    EXPECT_EQ(pane.roughness, 0.5f);
    const auto expected = detail::partly_covering({glm::vec3(0.5f), 0.0f}, 0.5f);
    EXPECT_EQ(glm::vec3(pane.base_color), expected.color.base_color);
    EXPECT_EQ(pane.metallic, expected.color.metallic);
}

TEST(GltfTransmission, AlphaScalesWhatIsNotTransmitted) {
    Json material = glass({1, 1, 1, 0.25}, {{"transmissionFactor", 0.5}});
    material["alphaMode"] = "BLEND";
    EXPECT_FLOAT_EQ(read_one(material).base_color.a, 0.25f * (1.0f - 0.48f));
    material["alphaMode"] = "MASK";
    EXPECT_EQ(read_one(material).base_color.a, 0.0f);
    material["alphaCutoff"] = 0.25;
    EXPECT_FLOAT_EQ(read_one(material).base_color.a, 1.0f - 0.48f);
}

TEST(GltfTransmission, EmissionIsAsBrightAsBefore) {
    Json material = glass({1, 1, 1, 1}, {{"transmissionFactor", 0.5}});
    material["emissiveFactor"] = {1, 0.5, 0};
    const Material pane = read_one(material);
    const glm::vec3 visible = pane.base_color.a * pane.emission;
    EXPECT_LT(glm::distance(visible, glm::vec3(1.0f, 0.5f, 0.0f)), 1e-6f);
}

TEST(GltfTransmission, NothingThatShinesThroughChangesNothing) {
    for (const Json& transmission :
         {Json{{"transmissionFactor", 0}, {"transmissionTexture", {{"index", 0}}}},
          Json::object()}) {
        GltfImageScene gltf;
        gltf.json["images"] = {{{"uri", "missing.png"}}};
        gltf.json["textures"] = {{{"source", 0}}};
        gltf.add_painted(glass({0.5, 0.25, 0.75, 0.5}, transmission));
        Material plain = read_one({{"pbrMetallicRoughness",
                                    {{"baseColorFactor", {0.5, 0.25, 0.75, 0.5}},
                                     {"metallicFactor", 0},
                                     {"roughnessFactor", 0.5}}}});
        EXPECT_EQ(gltf.scene().materials.at(0), plain);
    }
}

TEST(GltfTransmission, BlackTexturesLetNothingThrough) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{0, 255, 255, 255}, {0, 9, 9, 9}}});
    gltf.add_painted(
        glass({1, 1, 1, 1}, {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}));
    const Scene scene = gltf.scene();
    EXPECT_EQ(scene.materials.at(0).alpha_mode, AlphaMode::Opaque);
    EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1.0f));
    EXPECT_TRUE(scene.textures.empty());
}

TEST(GltfTransmission, UnlitMaterialsLetNothingThrough) {
    Json material = glass({1, 1, 1, 1}, {{"transmissionFactor", 1}});
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    EXPECT_EQ(read_one(material).alpha_mode, AlphaMode::Opaque);
}

/// Alpha, and alpha times reflectivity, at texture coordinates.
struct Pane {
    Scene scene;

    glm::vec4 color(glm::vec2 uv) { return base_color(scene, at(uv)); }

    float reflection(glm::vec2 uv) { return color(uv).a * diffuse_reflectivity(scene, at(uv)).r; }

  private:
    MeshPoint at(glm::vec2 uv) {
        for (auto& uvs : scene.meshes[0].uvs) uvs.assign(3, uv);
        return mesh_point(scene.meshes[0], 0, {0.25f, 0.5f});
    }
};

TEST(GltfTransmission, TexturesAreConvertedTexelByTexel) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{200, 200, 200, 9}, {100, 100, 100, 9}}});  // colour, across
    gltf.add_image({1, 2, {{255, 0, 0, 255}, {102, 0, 0, 255}}});      // transmission, down
    gltf.add_image({2, 1, {{0, 255, 51, 255}, {0, 51, 0, 255}}});      // factors, across
    Json material =
        glass({1, 1, 1, 1}, {{"transmissionFactor", 0.5}, {"transmissionTexture", {{"index", 1}}}});
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                        {"metallicRoughnessTexture", {{"index", 2}}}};
    gltf.add_painted(material);
    Pane pane{gltf.scene()};
    ASSERT_EQ(pane.scene.textures.size(), 2u);
    EXPECT_EQ(pane.scene.textures[0].image.height, 2u);
    for (int i = 0; i < 4; ++i) {
        const bool is_left = i % 2 == 0, is_top = i < 2;
        const glm::vec2 uv(is_left ? 0.25f : 0.75f, is_top ? 0.25f : 0.75f);
        const detail::MetallicColor color{glm::vec3(linear_from_srgb8(is_left ? 200 : 100)),
                                          is_left ? 0.2f : 0.0f};
        const float transmission = is_top ? 0.5f : 0.2f;
        EXPECT_NEAR(1.0f - pane.color(uv).a, exact_transmission(color, transmission).r, 0.003f);
        EXPECT_NEAR(pane.reflection(uv),
                    exact_reflection(color, transmission, is_left ? 1.0f : 0.2f).r, 0.006f);
    }
}

TEST(GltfTransmission, TexturesOfOtherCoordinatesCountByTheirMean) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{200, 200, 200, 255}, {100, 100, 100, 255}}});
    gltf.add_image({1, 2, {{255, 0, 0, 255}, {51, 0, 0, 255}}});
    Json material = glass({1, 1, 1, 1}, {{"transmissionFactor", 0.5},
                                         {"transmissionTexture", {{"index", 1}, {"texCoord", 1}}}});
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    gltf.add_painted(material);
    Pane pane{gltf.scene()};
    for (const float v : {0.25f, 0.75f}) {
        const detail::MetallicColor color{glm::vec3(linear_from_srgb8(200)), 0.0f};
        EXPECT_NEAR(1.0f - pane.color({0.25f, v}).a, exact_transmission(color, 0.3f).r, 0.003f);
    }
}

TEST(GltfTransmission, FactorsWithoutVariationNeedNoTexture) {
    GltfImageScene gltf;
    gltf.add_image({2, 1, {{255, 0, 0, 255}, {0, 0, 0, 255}}});
    Json material = glass({0, 0.5, 0.5, 1},
                          {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}});
    gltf.add_painted(material);
    gltf.add_painted(material);
    const Scene scene = gltf.scene();
    EXPECT_EQ(scene.materials.at(0).base_color_texture, scene.materials.at(1).base_color_texture);
    EXPECT_EQ(scene.textures.size(), 2u);  // colours and factors, once for both
    GltfImageScene metal;
    metal.add_image({1, 1, {{255, 0, 0, 255}}});
    metal.add_painted(material);
    EXPECT_TRUE(metal.scene().textures.empty());
}

TEST(GltfTransmission, AlphaOfVertexColorsStaysWithoutEffectOnOpaqueMaterials) {
    const std::vector<float> colors = {1, 0, 0, 0.5f, 0, 1, 0, 0, 0, 0, 1, 1};
    for (const bool is_opaque : {true, false}) {
        Json material = glass({1, 1, 1, 1}, {{"transmissionFactor", 0.5}});
        if (!is_opaque) material["alphaMode"] = "BLEND";
        GltfImageScene gltf;
        const size_t mesh = gltf.add_painted(material);
        gltf.primitive(mesh)["attributes"]["COLOR_0"] = gltf.add_floats(colors, "VEC4");
        const Scene scene = gltf.scene();
        EXPECT_EQ(scene.meshes.at(0).colors.at(0),
                  glm::vec4(1.0f, 0.0f, 0.0f, is_opaque ? 1.0f : 0.5f));
    }
}

TEST(GltfTransmission, WarnsOfGlassThatColorsLight) {
    const auto warnings = [](Json base_color, double transmission) {
        GltfImageScene gltf;
        gltf.add_painted(glass(std::move(base_color), {{"transmissionFactor", transmission}}));
        return gltf.scene().warnings;
    };
    EXPECT_TRUE(warnings({0.9, 0.91, 0.9, 1}, 1.0).empty());
    EXPECT_TRUE(warnings({1, 0, 0, 1}, 0.0).empty());
    const auto colored = warnings({1, 0, 0, 1}, 0.5);
    ASSERT_EQ(colored.size(), 1u);
    EXPECT_TRUE(colored[0].ends_with(
        "coloured glass (material 0): light that shines through is not coloured"))
        << colored[0];
}

TEST(GltfTransmission, FactorsOutOfRangeAreErrors) {
    GltfImageScene gltf;
    gltf.add_painted(glass({1, 1, 1, 1}, {{"transmissionFactor", 1.5}}));
    EXPECT_EQ(gltf.error(), "scene.glb: material 0: transmissionFactor 1.5 is not in 0 to 1");
}

}  // namespace
}  // namespace tetralight
