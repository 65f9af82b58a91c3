// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_texture_coordinates.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tetralight {
namespace {

/// A mesh "wall" of triangles with the attribute TEXCOORD_0 and a material "bricks", which has a
/// base colour texture.
detail::GltfDocument bricks() {
    detail::GltfDocument document;
    detail::GltfMaterial material;
    material.name = "bricks";
    material.base_color_texture.texture = 0;
    document.materials = {material};
    document.textures = {{"clay", 0, kNoIndex, kNoIndex}};
    detail::GltfPrimitive primitive;
    primitive.attributes = {{"POSITION", 0}, {"TEXCOORD_0", 1}};
    primitive.material = 0;
    document.meshes = {{"wall", {primitive}, {}}};
    return document;
}

std::vector<ScenePart> missing(const detail::GltfDocument& document) {
    detail::PartList parts;
    detail::add_missing_coordinates(document, parts);
    return parts.parts();
}

TEST(GltfTextureCoordinates, NamesTheTextureAndTheMeshThatLacksThem) {
    detail::GltfDocument document = bricks();
    EXPECT_TRUE(missing(document).empty());
    document.materials[0].base_color_texture.uv_set = 1;
    const auto parts = missing(document);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(detail::part_warning(parts[0]),
              "baseColorTexture of material 0 \"bricks\" (mesh 0 \"wall\"): is read as white where "
              "meshes have no TEXCOORD_1; export the meshes with TEXCOORD_1, or take the texture "
              "away");
    EXPECT_TRUE(parts[0].changes_light);
}

TEST(GltfTextureCoordinates, ConvertedTexturesNeedThem) {
    detail::GltfDocument document = bricks();
    detail::GltfMaterial& material = document.materials[0];
    document.meshes[0].primitives[0].attributes.erase("TEXCOORD_0");
    material.base_color_texture = {};
    material.specular_glossiness.emplace().diffuse_texture.texture = 0;
    auto parts = missing(document);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].name, "diffuseTexture of material 0 \"bricks\"");
    EXPECT_TRUE(parts[0].changes_light);
    material.specular_glossiness.reset();
    material.transmission.emplace().texture.texture = 0;
    EXPECT_TRUE(missing(document).empty());  // its factor is 0
    material.transmission->factor = 0.5;
    parts = missing(document);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].name, "transmissionTexture of material 0 \"bricks\"");
    EXPECT_EQ(parts[0].note,
              "is not applied, and the surface is opaque where meshes have no TEXCOORD_0");
}

TEST(GltfTextureCoordinates, TexturesWithoutAnEffectDoNotNeedThem) {
    detail::GltfDocument document = bricks();
    detail::GltfMaterial& material = document.materials[0];
    material.base_color_texture = {};
    material.emission_texture.texture = 0;
    material.metallic_roughness_texture.texture = 0;
    material.metallic = material.roughness = 0.0;
    document.meshes[0].primitives[0].attributes.erase("TEXCOORD_0");
    EXPECT_TRUE(missing(document).empty());
    material.emissive_factor = glm::dvec3(0, 0, 1);
    material.roughness = 1.0;
    EXPECT_EQ(missing(document).size(), 2u);
    material.is_unlit = true;
    EXPECT_TRUE(missing(document).empty());
}

TEST(GltfTextureCoordinates, TexturesWithoutAnImageDoNotNeedThem) {
    detail::GltfDocument document = bricks();
    document.meshes[0].primitives[0].attributes.erase("TEXCOORD_0");
    EXPECT_EQ(missing(document).size(), 1u);
    document.textures[0].image = kNoIndex;
    EXPECT_TRUE(missing(document).empty());
}

TEST(GltfTextureCoordinates, LinesDoNotNeedThem) {
    detail::GltfDocument document = bricks();
    document.meshes[0].primitives[0].attributes.erase("TEXCOORD_0");
    EXPECT_EQ(missing(document).size(), 1u);
    document.meshes[0].primitives[0].mode = 1;
    EXPECT_TRUE(missing(document).empty());
}

}  // namespace
}  // namespace tetralight
