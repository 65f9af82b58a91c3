// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/lightmap_glb.h>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>

#include "tests/bake/scene/gltf_builder.h"

// Files with compressed meshes, from their JSON to the scene and to the file with lightmaps.

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// Two triangles, at z = `height`.
std::vector<glm::vec3> square(float height) {
    return {{0, 0, height}, {1, 0, height}, {1, 1, height},
            {0, 0, height}, {1, 1, height}, {0, 1, height}};
}

std::vector<uint8_t> draco_square(float height) {
    const std::vector<glm::vec3> corners = square(height);
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (uint32_t i = 0; i < 2; ++i) {
        const glm::vec3* corner = &corners[3 * i];
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(i), corner, corner + 1,
                                          corner + 2);
    }
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);  // keeps the order of triangles
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

/// Two primitives of one mesh, at z = 0 and z = 5, which share their accessors.
GltfBuilder draco_scene() {
    GltfBuilder gltf;
    gltf.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    gltf.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    gltf.add("accessors", {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
    Json primitives = Json::array();
    for (const float height : {0.0f, 5.0f}) {
        const size_t view = gltf.add_view(draco_square(height));
        const Json draco = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
        primitives.push_back({{"attributes", {{"POSITION", 0}}},
                              {"indices", 1},
                              {"extensions", {{"KHR_draco_mesh_compression", draco}}}});
    }
    gltf.add_root({{"mesh", gltf.add("meshes", {{"primitives", primitives}})}});
    return gltf;
}

/// A view of compressed elements, whose plain bytes a buffer without bytes stands for.
size_t add_meshopt_view(GltfBuilder& gltf, const std::vector<uint8_t>& bytes, Json meshopt) {
    const size_t source = gltf.add_view(bytes);
    Json& view = gltf.json["bufferViews"][source];
    meshopt["buffer"] = 0;
    meshopt["byteOffset"] = view["byteOffset"];
    meshopt["byteLength"] = bytes.size();
    const size_t size = meshopt["count"].get<size_t>() * meshopt["byteStride"].get<size_t>();
    view = {{"buffer", 1},
            {"byteLength", size},
            {"extensions", {{"EXT_meshopt_compression", meshopt}}}};
    return source;
}

GltfBuilder meshopt_scene() {
    const std::vector<glm::vec3> corners = square(5.0f);
    std::vector<uint8_t> bytes(meshopt_encodeVertexBufferBound(6, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), corners.data(), 6, 12));
    GltfBuilder gltf;
    gltf.json["extensionsUsed"] = {"EXT_meshopt_compression"};
    gltf.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    const size_t view =
        add_meshopt_view(gltf, bytes, {{"byteStride", 12}, {"count", 6}, {"mode", "ATTRIBUTES"}});
    gltf.add("accessors",
             {{"bufferView", view}, {"componentType", 5126}, {"count", 6}, {"type", "VEC3"}});
    const Json fallback = {{"EXT_meshopt_compression", {{"fallback", true}}}};
    gltf.json["buffers"] = {{{"byteLength", gltf.binary.size()}},
                            {{"byteLength", 72}, {"extensions", fallback}}};
    const Json primitive = {{"attributes", {{"POSITION", 0}}}};
    gltf.add_root({{"mesh", gltf.add("meshes", {{"primitives", {primitive}}})}});
    return gltf;
}

std::vector<glm::vec3> corners_of(const Mesh& mesh) {
    std::vector<glm::vec3> corners;
    for (const uint32_t index : mesh.indices) corners.push_back(mesh.positions[index]);
    return corners;
}

/// The scene of the file with lightmaps: UVs for each mesh, all the same.
Scene with_lightmaps(const GltfBuilder& gltf, std::vector<GltfLightmapPlace> places) {
    const std::vector<glm::vec2> uvs(6, glm::vec2(0.5f));
    const TempFolder folder;
    const auto bytes = make_lightmap_glb(folder.write("scene.glb", gltf.glb()),
                                         {{uvs}, std::move(places), {}, 1.0});
    EXPECT_TRUE(bytes) << (bytes ? "" : error_text(bytes.error()));
    if (!bytes) return {};
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    EXPECT_EQ(text.find("EXT_meshopt"), std::string::npos);
    const auto scene = read_gltf(folder.write("written.glb", text));
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    return scene ? *scene : Scene{};
}

/// The corners of each instance, in order.
std::vector<std::vector<glm::vec3>> shown(const Scene& scene) {
    std::vector<std::vector<glm::vec3>> result;
    for (const MeshInstance& instance : scene.instances) {
        result.push_back(corners_of(scene.meshes[instance.mesh]));
    }
    return result;
}

const GltfLightmapPlace kPlace{0, 0, glm::vec2(0.25f), glm::vec2(0.0f)};

TEST(CompressedGltf, DracoIsReadAndGetsLightmaps) {
    const GltfBuilder gltf = draco_scene();
    const std::vector<std::vector<glm::vec3>> expected = {square(0), square(5)};
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(shown(*scene), expected);
    EXPECT_EQ(shown(with_lightmaps(gltf, {kPlace, kPlace})), expected);
    EXPECT_EQ(shown(with_lightmaps(gltf, {{}, kPlace})), expected);
}

TEST(CompressedGltf, MeshoptIsReadAndGetsLightmaps) {
    const GltfBuilder gltf = meshopt_scene();
    const std::vector<std::vector<glm::vec3>> expected = {square(5)};
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(shown(*scene), expected);
    EXPECT_EQ(shown(with_lightmaps(gltf, {kPlace})), expected);
    EXPECT_EQ(shown(with_lightmaps(gltf, {GltfLightmapPlace{}})), expected);
}

/// A skinned node and a plain one, of the same triangle, and an animation that lifts the joint by
/// 2 within a second.
GltfBuilder skinned_scene() {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    auto& attributes = gltf.primitive(mesh)["attributes"];
    attributes["JOINTS_0"] = gltf.add_accessor(std::vector<uint8_t>(12, 0), "VEC4", 5121);
    attributes["WEIGHTS_0"] = gltf.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    gltf.add_root({{"name", "joint"}, {"translation", {0, 0, 1}}});
    gltf.add("skins", {{"joints", {0}}});
    gltf.add_root({{"name", "hero"}, {"mesh", mesh}, {"skin", 0}});
    gltf.add_root({{"name", "wall"}, {"mesh", mesh}});
    const size_t times = gltf.add_floats({0, 1}, "SCALAR");
    const size_t values = gltf.add_floats({0, 0, 1, 0, 0, 3}, "VEC3");
    const Json target = {{"node", 0}, {"path", "translation"}};
    gltf.add("animations", {{"name", "rise"},
                            {"samplers", {{{"input", times}, {"output", values}}}},
                            {"channels", {{{"sampler", 0}, {"target", target}}}}});
    return gltf;
}

TEST(CompressedGltf, SkinsStandWhereAnAnimationHasThem) {
    const auto rest = skinned_scene().read();
    ASSERT_TRUE(rest) << error_text(rest.error());
    EXPECT_EQ(shown(*rest)[0][0], glm::vec3(0, 0, 1));
    EXPECT_EQ(shown(*rest)[1][0], glm::vec3(0, 0, 0));
    EXPECT_TRUE(rest->warnings.empty());
    const auto moved = skinned_scene().read({.time = 0.5, .animation = "rise"});
    ASSERT_TRUE(moved) << error_text(moved.error());
    EXPECT_EQ(shown(*moved)[0][0], glm::vec3(0, 0, 2));
    EXPECT_EQ(skinned_scene().error({.time = 0.5, .animation = "fall"}),
              "scene.glb: has no animation \"fall\"; it has 0 \"rise\"");
}

TEST(CompressedGltf, SkinnedNodesStandBesideLightmaps) {
    const std::vector<glm::vec2> uvs(3, glm::vec2(0.5f));
    const TempFolder folder;
    const std::string path = folder.write("scene.glb", skinned_scene().glb());
    const auto bytes = make_lightmap_glb(path, {{uvs}, {{}, kPlace}, {}, 1.0});
    ASSERT_TRUE(bytes) << error_text(bytes.error());
    const auto refused = make_lightmap_glb(path, {{uvs}, {kPlace, kPlace}, {}, 1.0});
    ASSERT_FALSE(refused);
    EXPECT_NE(error_text(refused.error())
                  .find("node 1 \"hero\" is deformed by morph targets or a skin, so that it has no "
                        "lightmap"),
              std::string::npos);
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const auto scene = read_gltf(folder.write("written.glb", text));
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(shown(*scene)[0][0], glm::vec3(0, 0, 1));
    EXPECT_EQ(shown(*scene)[1][0], glm::vec3(0, 0, 0));
}

}  // namespace
}  // namespace tetralight
