// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_materials.h>

#include <gtest/gtest.h>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// A scene of one triangle with one material.
GltfBuilder painted(Json material) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["material"] = gltf.add("materials", std::move(material));
    gltf.add_root({{"mesh", mesh}});
    return gltf;
}

/// The first material of a scene; a default one, and a failed test, where there is none.
Material material_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene || scene->materials.empty()) return {};
    return scene->materials[0];
}

Json emitter(Json factor, double strength) {
    return {
        {"emissiveFactor", std::move(factor)},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}};
}

/// A material with these properties and one PNG of one texel, texture 0.
GltfBuilder with_factor_texture(Json metallic_roughness) {
    GltfBuilder gltf = painted({{"pbrMetallicRoughness", std::move(metallic_roughness)}});
    const TempFolder folder;
    const std::string path = folder.path("texel.png");
    EXPECT_TRUE(write_png(path, Image8{1, 1, {{0, 51, 102, 255}}}));
    const auto bytes = read_file(path);
    EXPECT_TRUE(bytes);
    gltf.add("images", {{"bufferView", gltf.add_view(*bytes)}, {"mimeType", "image/png"}});
    gltf.add("textures", {{"source", 0}});
    return gltf;
}

TEST(GltfMaterials, DefaultsAreThoseOfGltf) {
    const Material expected;  // white, metallic 1, roughness 1, no emission, opaque, cutoff 0.5
    EXPECT_EQ(material_of(painted(Json::object())), expected);
}

TEST(GltfMaterials, FactorsAreTakenAsLinear) {
    const Material material = material_of(painted({{"name", "clay"},
                                                   {"doubleSided", true},
                                                   {"pbrMetallicRoughness",
                                                    {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}},
                                                     {"metallicFactor", 0.0},
                                                     {"roughnessFactor", 0.5}}}}));
    EXPECT_EQ(material.name, "clay");
    EXPECT_EQ(material.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 0.75f));
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.roughness, 0.5f);
    EXPECT_TRUE(material.is_double_sided);
}

TEST(GltfMaterials, StrengthMultipliesEmission) {
    EXPECT_EQ(material_of(painted(emitter({1.0, 0.5, 0.0}, 40))).emission, glm::vec3(40, 20, 0));
}

TEST(GltfMaterials, EmissionWithoutStrengthIsTheFactor) {
    EXPECT_EQ(material_of(painted({{"emissiveFactor", {0.5, 1, 0}}})).emission,
              glm::vec3(0.5f, 1, 0));
}

TEST(GltfMaterials, AlphaModes) {
    EXPECT_EQ(material_of(painted({{"alphaMode", "OPAQUE"}})).alpha_mode, AlphaMode::Opaque);
    EXPECT_EQ(material_of(painted({{"alphaMode", "BLEND"}})).alpha_mode, AlphaMode::Blend);
    const Material mask = material_of(painted({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}}));
    EXPECT_EQ(mask.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(mask.alpha_cutoff, 0.25f);
}

TEST(GltfMaterials, UnlitIsAnEmptyExtension) {
    GltfBuilder gltf = painted({{"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    gltf.json["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_TRUE(material_of(gltf).is_unlit);
    EXPECT_FALSE(material_of(painted(Json::object())).is_unlit);
}

TEST(GltfMaterials, BakeEmissionIsAWordOrABoolean) {
    const auto bakes = [](const Json& value) {
        return material_of(painted({{"extras", {{"bake_emission", value}}}})).bakes_emission;
    };
    EXPECT_TRUE(bakes("baked"));
    EXPECT_TRUE(bakes(true));
    EXPECT_FALSE(bakes("none"));
    EXPECT_FALSE(bakes(false));
}

TEST(GltfMaterials, MetallicRoughnessTexture) {
    const GltfBuilder gltf = with_factor_texture(
        {{"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}, {"metallicFactor", 0}});
    const Material material = material_of(gltf);
    EXPECT_EQ(material.metallic_roughness_texture.texture, 0u);
    EXPECT_EQ(material.metallic_roughness_texture.uv_set, 1u);
}

TEST(GltfMaterials, FactorTextureOfZeroFactorsIsNotRead) {
    GltfBuilder gltf = with_factor_texture({{"metallicRoughnessTexture", {{"index", 0}}},
                                            {"metallicFactor", 0},
                                            {"roughnessFactor", 0}});
    gltf.json["images"][0] = {{"uri", "missing.png"}};
    EXPECT_EQ(material_of(gltf).metallic_roughness_texture.texture, kNoIndex);
}

TEST(GltfMaterials, NamesAFactorTextureFileThatIsMissing) {
    GltfBuilder gltf = with_factor_texture({{"metallicRoughnessTexture", {{"index", 0}}}});
    gltf.json["images"][0] = {{"uri", "missing.png"}};
    EXPECT_TRUE(gltf.error().starts_with(
        "scene.glb: material 0: metallicRoughnessTexture: texture 0: image 0: "))
        << gltf.error();
}

TEST(GltfMaterials, MeshesWithoutMaterialShareOneDefault) {
    GltfBuilder gltf = painted({{"name", "clay"}});
    gltf.add_triangle();
    gltf.add_triangle();
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->materials.size(), 2u);
    EXPECT_EQ(scene->materials[1].base_color, glm::vec4(1.0f));
    EXPECT_EQ(scene->meshes[0].material, 0u);
    EXPECT_EQ(scene->meshes[1].material, 1u);
    EXPECT_EQ(scene->meshes[2].material, 1u);
}

TEST(GltfMaterials, NoDefaultIsAddedWhereNoneIsNeeded) {
    const auto scene = painted({{"name", "clay"}}).read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->materials.size(), 1u);
}

struct MaterialRejection {
    const char* label;
    Json material;
    const char* error;
};

class GltfMaterialsReject : public testing::TestWithParam<MaterialRejection> {};

TEST_P(GltfMaterialsReject, WithPlaceAndValue) {
    EXPECT_EQ(painted(GetParam().material).error(),
              std::string("scene.glb: material 0: ") + GetParam().error);
}

Json pbr(const char* key, Json value) {
    return {{"pbrMetallicRoughness", {{key, std::move(value)}}}};
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfMaterialsReject,
    testing::Values(
        MaterialRejection{
            "Emission", {{"emissiveFactor", {0, -1, 0}}}, "emissiveFactor -1 is negative"},
        MaterialRejection{"Strength", emitter({1, 1, 1}, -2), "emissiveStrength -2 is negative"},
        MaterialRejection{"Overflow", emitter({1, 1, 1}, 1e300),
                          "emission is not finite (1 * 1e+300)"},
        MaterialRejection{"BaseColor", pbr("baseColorFactor", {1, 1, 1.5, 1}),
                          "baseColorFactor 1.5 is not in 0 to 1"},
        MaterialRejection{"Metallic", pbr("metallicFactor", -0.5),
                          "metallicFactor -0.5 is not in 0 to 1"},
        MaterialRejection{"Roughness", pbr("roughnessFactor", 2),
                          "roughnessFactor 2 is not in 0 to 1"},
        MaterialRejection{"AlphaMode",
                          {{"alphaMode", "CUTOUT"}},
                          "alphaMode \"CUTOUT\" is not OPAQUE, MASK or BLEND"},
        MaterialRejection{"BakeEmission",
                          {{"extras", {{"bake_emission", "dynamic"}}}},
                          "extras.bake_emission \"dynamic\" is neither \"none\" nor \"baked\""},
        MaterialRejection{
            "BakeEmissionNumber",
            {{"extras", {{"bake_emission", 2}}}},
            "extras.bake_emission \"(not a string)\" is neither \"none\" nor \"baked\""},
        MaterialRejection{
            "AlphaCutoff", {{"alphaCutoff", -1}}, "alphaCutoff -1 is negative or too large"}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

}  // namespace
}  // namespace tetralight
