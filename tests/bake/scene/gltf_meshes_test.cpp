// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Indices = std::vector<uint32_t>;

/// Five corners in a zigzag along x.
const std::vector<float> kZigzag = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0};

/// A scene with one node that shows the zigzag in a primitive mode.
GltfBuilder zigzag_scene(int mode) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_mesh(kZigzag);
    gltf.primitive(mesh)["mode"] = mode;
    gltf.add_root({{"mesh", mesh}});
    return gltf;
}

Indices indices_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene || scene->meshes.size() != 1) return {};
    return scene->meshes[0].indices;
}

TEST(GltfMeshes, TrianglesWithoutIndicesTakeVerticesInOrder) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene->meshes[0].indices, (Indices{0, 1, 2}));
}

template <class Index>
Indices read_indices_of_type(int component_type) {
    GltfBuilder gltf = zigzag_scene(4);
    gltf.primitive(0)["indices"] =
        gltf.add_accessor(std::vector<Index>{2, 0, 1, 4, 3, 2}, "SCALAR", component_type);
    return indices_of(gltf);
}

TEST(GltfMeshes, IndicesOfAllThreeTypes) {
    const Indices expected = {2, 0, 1, 4, 3, 2};
    EXPECT_EQ(read_indices_of_type<uint8_t>(5121), expected);
    EXPECT_EQ(read_indices_of_type<uint16_t>(5123), expected);
    EXPECT_EQ(read_indices_of_type<uint32_t>(5125), expected);
}

TEST(GltfMeshes, StripKeepsOneWinding) {
    EXPECT_EQ(indices_of(zigzag_scene(5)), (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(GltfMeshes, StripDropsTrianglesThatJoin) {
    GltfBuilder gltf = zigzag_scene(5);
    gltf.primitive(0)["indices"] =
        gltf.add_accessor(std::vector<uint16_t>{0, 1, 2, 2, 3, 3, 4}, "SCALAR", 5123);
    EXPECT_EQ(indices_of(gltf), (Indices{0, 1, 2}));
}

TEST(GltfMeshes, FanTurnsAboutItsFirstCorner) {
    EXPECT_EQ(indices_of(zigzag_scene(6)), (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfMeshes, PointsAndLinesAreLeftOut) {
    for (const int mode : {0, 1, 2, 3}) {
        const auto scene = zigzag_scene(mode).read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        EXPECT_TRUE(scene->meshes.empty());
        EXPECT_TRUE(scene->instances.empty());
        EXPECT_TRUE(scene->warnings.empty());
    }
}

TEST(GltfMeshes, NormalsAndBothUvSets) {
    GltfBuilder gltf;
    auto mesh = gltf.add_triangle();
    auto& attributes = gltf.primitive(mesh)["attributes"];
    attributes["NORMAL"] = gltf.add_floats({0, 0, 1, 0, 1, 0, 1, 0, 0}, "VEC3");
    attributes["TEXCOORD_0"] = gltf.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
    attributes["TEXCOORD_1"] = gltf.add_floats({5, 6, 7, 8, 9, 10}, "VEC2");
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_EQ(scene->meshes[0].uvs[0], (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_EQ(scene->meshes[0].uvs[1], (std::vector<glm::vec2>{{5, 6}, {7, 8}, {9, 10}}));
}

TEST(GltfMeshes, TangentsAreReadWithNormalMaps) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.primitive(0)["attributes"]["TANGENT"] =
        gltf.add_floats({1, 0, 0, 1, 0, 1, 0, -1, 0, 0, 1, 1}, "VEC4");
    EXPECT_TRUE(gltf.read()->meshes[0].tangents.empty());
    const auto scene = gltf.read({.normal_maps = NormalMaps::Read});
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].tangents,
              (std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 1, 0, -1}, {0, 0, 1, 1}}));
}

TEST(GltfMeshes, NamesWhatIsWrongWithTangents) {
    GltfBuilder gltf;
    gltf.add_triangle();
    auto& tangent = gltf.primitive(0)["attributes"]["TANGENT"];
    tangent = gltf.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    EXPECT_NE(gltf.error({.normal_maps = NormalMaps::Read})
                  .find("TANGENT: accessor 1: is not of type VEC4"),
              std::string::npos);
    tangent = gltf.add_floats({1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    EXPECT_NE(gltf.error({.normal_maps = NormalMaps::Read})
                  .find("TANGENT has 2 elements, POSITION has 3"),
              std::string::npos);
}

TEST(GltfMeshes, VertexColorsHaveThreeOrFourChannels) {
    GltfBuilder gltf;
    auto& opaque = gltf.primitive(gltf.add_triangle())["attributes"];
    opaque["COLOR_0"] = gltf.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5f}, "VEC3");
    auto& clear = gltf.primitive(gltf.add_triangle())["attributes"];
    clear["COLOR_0"] = gltf.add_floats({1, 0, 0, 0.5f, 0, 1, 0, 1, 0, 0, 1, 0}, "VEC4");
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].colors,
              (std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0.5f, 1}}));
    EXPECT_EQ(scene->meshes[1].colors,
              (std::vector<glm::vec4>{{1, 0, 0, 0.5f}, {0, 1, 0, 1}, {0, 0, 1, 0}}));
}

TEST(GltfMeshes, NegativeVertexColorsAreNamed) {
    GltfBuilder gltf;
    auto& attributes = gltf.primitive(gltf.add_triangle())["attributes"];
    attributes["COLOR_0"] = gltf.add_floats({1, 0, 0, 0, -0.5f, 0, 0, 0, 1}, "VEC3");
    const auto scene = gltf.read();
    ASSERT_FALSE(scene);
    EXPECT_NE(error_text(scene.error()).find("COLOR_0"), std::string::npos)
        << error_text(scene.error());
    EXPECT_NE(error_text(scene.error()).find("element 1 is negative (-0.5)"), std::string::npos)
        << error_text(scene.error());
}

TEST(GltfMeshes, IntegerColorsHaveToBeNormalized) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t colors = gltf.add_accessor(
        std::vector<uint8_t>{255, 0, 0, 255, 0, 51, 0, 255, 0, 0, 0, 255}, "VEC4", 5121);
    gltf.primitive(mesh)["attributes"]["COLOR_0"] = colors;
    gltf.add_root({{"mesh", mesh}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0: primitive 0: COLOR_0: has integers that are not \"normalized\"; "
              "set \"normalized\": true, so that the largest integer is 1");
    gltf.json["accessors"][colors]["normalized"] = true;
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_FLOAT_EQ(scene->meshes[0].colors.at(1).y, 51.0f / 255.0f);
}

TEST(GltfMeshes, IntegerTextureCoordinatesMayCountTexelsByAnExtension) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["attributes"]["TEXCOORD_1"] =
        gltf.add_accessor(std::vector<uint16_t>{0, 0, 7, 0, 0, 7}, "VEC2", 5123);
    gltf.add_root({{"mesh", mesh}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0: primitive 0: TEXCOORD_1: has integers that are not "
              "\"normalized\"; set \"normalized\": true, or list KHR_mesh_quantization in "
              "extensionsUsed if they count texels");
    gltf.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].uvs[1].at(1), glm::vec2(7, 0));
}

TEST(GltfMeshes, EachPrimitiveBecomesAMesh) {
    GltfBuilder gltf;
    const auto mesh = gltf.add_triangle();
    gltf.json["meshes"][mesh]["primitives"].push_back(gltf.primitive(mesh));
    gltf.add_root({{"mesh", mesh}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes.size(), 2u);
    ASSERT_EQ(scene->instances.size(), 2u);
    EXPECT_EQ(scene->instances[1].mesh, 1u);
}

TEST(GltfMeshes, TrianglesWithoutAreaAreLeftOutAndCounted) {
    GltfBuilder gltf;
    // Corner 3 lies on the edge from 0 to 1, corner 4 where corner 0 is.
    const size_t mesh =
        gltf.add_mesh({0, 0, 0, 0.3f, 0.3f, 0.3f, 0, 1, 0, 0.1f, 0.1f, 0.1f, 0, 0, 0});
    gltf.json["meshes"][mesh]["name"] = "wall";
    gltf.primitive(mesh)["indices"] = gltf.add_accessor(
        std::vector<uint16_t>{0, 3, 1, 0, 1, 2, 0, 2, 4, 2, 2, 1}, "SCALAR", 5123);
    gltf.add_root({{"mesh", mesh}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].indices, (Indices{0, 1, 2}));
    EXPECT_TRUE(scene->warnings.empty());  // they reflect no light
    const auto part = std::ranges::find(scene->parts, "triangles without area", &ScenePart::name);
    ASSERT_NE(part, scene->parts.end());
    EXPECT_EQ(part->use, PartUse::Ignored);
    EXPECT_EQ(part->count, 3u);
    EXPECT_EQ(part->elements, std::vector<std::string>{"mesh 0 \"wall\""});
}

TEST(GltfMeshes, ThinAndTinyTrianglesStay) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_mesh({0, 0, 0, 1e-12f, 0, 0, 0, 1e-12f, 0})}});
    gltf.add_root({{"mesh", gltf.add_mesh({0, 0, 0, 1000, 0, 0, 0, 1e-4f, 0})}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes.size(), 2u);
    EXPECT_TRUE(scene->warnings.empty());
}

TEST(GltfMeshes, OnePartCountsTheFlatTrianglesOfAllPrimitives) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_mesh({0, 0, 0, 1, 0, 0, 2, 0, 0});
    gltf.json["meshes"][mesh]["primitives"].push_back(gltf.primitive(mesh));
    gltf.add_root({{"mesh", mesh}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->meshes.empty());
    EXPECT_TRUE(scene->instances.empty());
    const auto part = std::ranges::find(scene->parts, "triangles without area", &ScenePart::name);
    ASSERT_NE(part, scene->parts.end());
    EXPECT_EQ(part->count, 2u);
    EXPECT_EQ(part->elements, std::vector<std::string>{"mesh 0"});
}

TEST(GltfMeshes, RejectsAnIndexOutOfRange) {
    GltfBuilder gltf = zigzag_scene(4);
    gltf.json["meshes"][0]["name"] = "wall";
    gltf.primitive(0)["indices"] =
        gltf.add_accessor(std::vector<uint16_t>{0, 1, 9123}, "SCALAR", 5123);
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0 \"wall\": primitive 0: index 9123 is out of range (5 vertices)");
}

TEST(GltfMeshes, RejectsPartsOfTriangles) {
    EXPECT_EQ(zigzag_scene(4).error(),
              "scene.glb: mesh 0: primitive 0: 5 corners do not make whole triangles");
}

TEST(GltfMeshes, RejectsAnUnknownMode) {
    EXPECT_EQ(zigzag_scene(7).error(), "scene.glb: mesh 0: primitive 0: mode 7 is not known");
}

TEST(GltfMeshes, RejectsAPrimitiveWithoutPositions) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.primitive(0)["attributes"] = {{"NORMAL", 0}};
    EXPECT_EQ(gltf.error(), "scene.glb: mesh 0: primitive 0: has no POSITION");
}

TEST(GltfMeshes, RejectsAttributesOfDifferentLengths) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.primitive(0)["attributes"]["TEXCOORD_1"] = gltf.add_floats({0, 0, 1, 1}, "VEC2");
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0: primitive 0: TEXCOORD_1 has 2 elements, POSITION has 3");
}

}  // namespace
}  // namespace tetralight
