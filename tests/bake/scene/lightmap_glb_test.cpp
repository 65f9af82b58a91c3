// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/lightmap_glb.h>

#include <gtest/gtest.h>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// A square of two triangles at x, y in [0, 1].
size_t add_square(GltfBuilder& gltf) {
    const size_t mesh = gltf.add_mesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    gltf.primitive(mesh)["indices"] =
        gltf.add_accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123);
    return mesh;
}

/// UVs of the square in one piece, and in two pieces.
const std::vector<glm::vec2> kWhole{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
const std::vector<glm::vec2> kSplit{{0, 0}, {0.4f, 0}, {0.4f, 1}, {0.6f, 0}, {1, 1}, {0.6f, 1}};

struct Written {
    Json json;
    std::string binary;
    Scene scene;
};

Written written(const GltfBuilder& gltf, const GltfLightmaps& lightmaps) {
    const TempFolder folder;
    const auto bytes = make_lightmap_glb(folder.write("scene.glb", gltf.glb()), lightmaps);
    EXPECT_TRUE(bytes) << (bytes ? "" : error_text(bytes.error()));
    if (!bytes) return {};
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    uint32_t length = 0;
    std::memcpy(&length, text.data() + 12, sizeof length);
    auto scene = read_gltf(folder.write("written.glb", text));
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    return {Json::parse(text.substr(20, length)), text.substr(20 + length + 8),
            scene ? std::move(*scene) : Scene{}};
}

std::string refusal(const GltfBuilder& gltf, const GltfLightmaps& lightmaps) {
    const TempFolder folder;
    const auto bytes = make_lightmap_glb(folder.write("scene.glb", gltf.glb()), lightmaps);
    return bytes ? "(no error)" : error_text(bytes.error());
}

/// The positions of all corners, in order, and their UVs of set 1.
std::vector<glm::vec3> corners(const Mesh& mesh) {
    std::vector<glm::vec3> result;
    for (const uint32_t index : mesh.indices) result.push_back(mesh.positions[index]);
    return result;
}

std::vector<glm::vec2> corner_uvs(const Mesh& mesh) {
    std::vector<glm::vec2> result;
    for (const uint32_t index : mesh.indices) result.push_back(mesh.uvs[1].at(index));
    return result;
}

GltfLightmapPlace place(uint32_t uvs, uint32_t page = 0, float offset = 0.0f) {
    return {uvs, page, glm::vec2(0.25f), glm::vec2(offset)};
}

TEST(LightmapGlb, SplitsVerticesWhereUvsDiffer) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "wall"}, {"mesh", add_square(gltf)}});
    const Written result = written(gltf, {{kSplit}, {place(0, 2, 0.5f)}, {}, 1.0});
    const Mesh& mesh = result.scene.meshes.at(0);
    EXPECT_EQ(corners(mesh), corners(gltf.read()->meshes[0]));
    EXPECT_EQ(corner_uvs(mesh), kSplit);
    EXPECT_EQ(mesh.positions.size(), 6u);
    const Json& rectangle = result.json["nodes"][0]["extras"]["lightmap_rectangle"];
    EXPECT_EQ(rectangle, Json::parse(R"({"page": 2, "scale": [0.25, 0.25],
                                         "offset": [0.5, 0.5], "texCoord": 1})"));
}

TEST(LightmapGlb, KeepsSharedVerticesAndReplacesTheOldArrays) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", add_square(gltf)}});
    const Written result = written(gltf, {{kWhole}, {place(0)}, {}, 1.0});
    EXPECT_EQ(result.scene.meshes.at(0).positions.size(), 4u);
    // Positions, UVs (also set 0) and indices: the old ones are gone.
    EXPECT_EQ(result.json["accessors"].size(), 3u);
    EXPECT_EQ(result.json["bufferViews"].size(), 3u);
    EXPECT_EQ(result.binary.size(), 4u * 12 + 4 * 8 + 6 * 2);
}

TEST(LightmapGlb, InstancesWithOtherUvsGetACopyOfTheMesh) {
    GltfBuilder gltf;
    const size_t mesh = add_square(gltf);
    gltf.json["meshes"][mesh]["name"] = "wall";
    for (const char* name : {"a", "b", "c", "d"}) gltf.add_root({{"name", name}, {"mesh", mesh}});
    const Written result =
        written(gltf, {{kWhole, kSplit}, {place(0), place(1), place(0), {}}, {}, 1.0});
    ASSERT_EQ(result.json["meshes"].size(), 2u);
    EXPECT_EQ(result.json["meshes"][1]["name"], "wall lightmap 2");
    const auto& scene = result.scene;
    EXPECT_EQ(corner_uvs(scene.meshes[scene.instances.at(1).mesh]), kSplit);
    EXPECT_EQ(corner_uvs(scene.meshes[scene.instances.at(2).mesh]), kWhole);
    EXPECT_EQ(scene.instances.at(3).mesh, scene.instances.at(0).mesh);
    EXPECT_FALSE(result.json["nodes"][3].contains("extras"));
}

TEST(LightmapGlb, CopiesQuantizedSparseAndMorphedAttributesAsTheyAre) {
    GltfBuilder gltf;
    const size_t mesh = add_square(gltf);
    const size_t joints = gltf.add_accessor(
        std::vector<uint8_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, "VEC4", 5121);
    const size_t colors = gltf.add_accessor(
        std::vector<uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC3", 5121);
    gltf.json["accessors"][colors]["normalized"] = true;
    const size_t indices = gltf.add_view(std::vector<uint8_t>{3});
    const size_t values = gltf.add_view(std::vector<float>{7, 8, 9});
    const size_t moved =
        gltf.add("accessors", {{"componentType", 5126},
                               {"count", 4},
                               {"type", "VEC3"},
                               {"min", {0, 0, 0}},
                               {"max", {7, 8, 9}},
                               {"sparse",
                                {{"count", 1},
                                 {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                 {"values", {{"bufferView", values}}}}}});
    gltf.primitive(mesh)["attributes"]["JOINTS_0"] = joints;
    gltf.primitive(mesh)["attributes"]["COLOR_0"] = colors;
    gltf.primitive(mesh)["targets"] = {{{"POSITION", moved}}};
    gltf.add_root({{"mesh", mesh}});
    const Written result = written(gltf, {{kSplit}, {place(0)}, {}, 1.0});
    const Json& primitive = result.json["meshes"][0]["primitives"][0];
    const auto bytes_of = [&](const Json& accessor) {
        const Json& view = result.json["bufferViews"][accessor["bufferView"].get<size_t>()];
        return result.binary.substr(view["byteOffset"], view["byteLength"]);
    };
    const Json& all = result.json["accessors"];
    // The sources of the six vertices are 0 1 2 0 2 3.
    const std::string joint_bytes =
        bytes_of(all[primitive["attributes"]["JOINTS_0"].get<size_t>()]);
    EXPECT_EQ(joint_bytes.substr(12, 8), std::string({0, 1, 2, 3, 8, 9, 10, 11}));
    const Json& color = all[primitive["attributes"]["COLOR_0"].get<size_t>()];
    EXPECT_EQ(color["normalized"], true);
    EXPECT_EQ(bytes_of(color).substr(4, 8), std::string({4, 5, 6, 0, 7, 8, 9, 0}));
    const Json& target = all[primitive["targets"][0]["POSITION"].get<size_t>()];
    EXPECT_EQ(target["count"], 6);
    EXPECT_EQ(target["max"], Json::parse("[7.0, 8.0, 9.0]"));
    EXPECT_FALSE(target.contains("sparse"));
}

TEST(LightmapGlb, StripsBecomeTrianglesWithoutFlatOnes) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    gltf.primitive(mesh)["mode"] = 5;
    gltf.primitive(mesh)["indices"] =
        gltf.add_accessor(std::vector<uint8_t>{0, 1, 2, 3, 3}, "SCALAR", 5121);
    gltf.add_root({{"mesh", mesh}});
    const auto before = gltf.read();
    ASSERT_EQ(before->meshes[0].indices.size(), 6u);
    const Written result = written(gltf, {{kSplit}, {place(0)}, {}, 1.0});
    EXPECT_EQ(corners(result.scene.meshes.at(0)), corners(before->meshes[0]));
    EXPECT_FALSE(result.json["meshes"][0]["primitives"][0].contains("mode"));
}

TEST(LightmapGlb, ASecondSetOfUvsThatAMaterialUsesStays) {
    GltfBuilder gltf;
    const size_t mesh = add_square(gltf);
    const size_t uvs = gltf.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    gltf.primitive(mesh)["attributes"]["TEXCOORD_0"] = uvs;
    gltf.primitive(mesh)["attributes"]["TEXCOORD_1"] = uvs;
    gltf.primitive(mesh)["material"] = 0;
    const Json material = {{"occlusionTexture", {{"index", 0}, {"texCoord", 1}}}};
    gltf.json["materials"] = Json::array({material});
    gltf.json["textures"] = Json::array({Json::object()});
    gltf.add_root({{"mesh", mesh}});
    const Written result = written(gltf, {{kSplit}, {place(0)}, {}, 1.0});
    EXPECT_EQ(result.json["nodes"][0]["extras"]["lightmap_rectangle"]["texCoord"], 2);
    EXPECT_TRUE(result.json["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_2"));
    EXPECT_EQ(corner_uvs(result.scene.meshes.at(0)), kWhole);
    gltf.json["materials"] = Json::array({Json::object()});
    EXPECT_EQ(corner_uvs(written(gltf, {{kSplit}, {place(0)}, {}, 1.0}).scene.meshes.at(0)),
              kSplit);
}

TEST(LightmapGlb, PrimitivesAndInstancesBecomeChildrenInTheSameOrder) {
    GltfBuilder gltf;
    const size_t mesh = add_square(gltf);
    const Json first = gltf.primitive(mesh);
    Json second = first;
    second["attributes"]["POSITION"] =
        gltf.add_floats({0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5}, "VEC3");
    gltf.json["meshes"][mesh]["primitives"] = {first, second};
    const size_t moves = gltf.add_floats({1, 2, 3, 4, 5, 6}, "VEC3");
    const Json instancing = {{"attributes", {{"TRANSLATION", moves}}}};
    const size_t child = gltf.add("nodes", {{"name", "child"}, {"mesh", mesh}});
    gltf.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    gltf.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    gltf.add_root({{"name", "trees"},
                   {"mesh", mesh},
                   {"children", {child}},
                   {"extensions", {{"EXT_mesh_gpu_instancing", instancing}}}});
    const auto before = gltf.read();
    ASSERT_EQ(before->instances.size(), 6u);
    std::vector<GltfLightmapPlace> places;
    for (uint32_t i = 0; i < 6; ++i) places.push_back(place(i % 2, i, 0.125f));
    const Written result = written(gltf, {{kWhole, kSplit}, places, {}, 1.0});
    ASSERT_EQ(result.scene.instances.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {
        const MeshInstance& now = result.scene.instances[i];
        EXPECT_EQ(now.world_from_mesh, before->instances[i].world_from_mesh) << i;
        EXPECT_EQ(corners(result.scene.meshes[now.mesh]),
                  corners(before->meshes[before->instances[i].mesh]));
        EXPECT_EQ(corner_uvs(result.scene.meshes[now.mesh]), i % 2 == 0 ? kWhole : kSplit);
    }
    EXPECT_FALSE(result.json.contains("extensionsRequired"));
    const Json& parent = result.json["nodes"][1];
    EXPECT_EQ(parent["children"].size(), 5u);
    EXPECT_EQ(result.json["nodes"][parent["children"][1].get<size_t>()]["name"],
              "trees instance 0 primitive 1");
}

TEST(LightmapGlb, AnimatedWeightsFollowTheMesh) {
    GltfBuilder gltf;
    const size_t mesh = add_square(gltf);
    gltf.json["meshes"][mesh]["primitives"].push_back(gltf.primitive(mesh));
    gltf.add_root({{"mesh", mesh}, {"weights", {0.5}}});
    gltf.json["animations"] = Json::parse(
        R"([{"samplers": [{"input": 0, "output": 0}, {"input": 0, "output": 0}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}},
             {"sampler": 1, "target": {"node": 0, "path": "scale"}}]}])");
    const Written result = written(gltf, {{kWhole}, {place(0), place(0)}, {}, 1.0});
    const Json& channels = result.json["animations"][0]["channels"];
    ASSERT_EQ(channels.size(), 3u);
    EXPECT_EQ(channels[0]["target"]["node"], 1);
    EXPECT_EQ(channels[1]["target"]["node"], 2);
    EXPECT_EQ(channels[2]["target"]["node"], 0);
    EXPECT_EQ(result.json["nodes"][2]["weights"], Json::parse("[0.5]"));
    EXPECT_FALSE(result.json["nodes"][0].contains("weights"));
}

TEST(LightmapGlb, PagesBecomeTexturesOfMxLightmap) {
    GltfBuilder gltf;
    gltf.json["extras"] = {{"kept", {1, 2.5, "three"}}};
    gltf.add_root({{"mesh", add_square(gltf)}, {"extras", {{"contribute_gi", true}}}});
    const std::vector<std::byte> page(5, std::byte{7});
    const Written result = written(gltf, {{kWhole}, {place(0, 1)}, {{}, page}, 2.0});
    const Json& lightmap = result.json["nodes"][0]["extensions"]["MX_lightmap"];
    EXPECT_EQ(lightmap, Json::parse(R"({"lightMapTexture": {"index": 1, "texCoord": 1},
        "scale": [0.25, 0.25], "offset": [0.0, 0.0], "intensity": 2.0})"));
    EXPECT_EQ(result.json["extensionsUsed"], Json::parse(R"(["MX_lightmap", "MX_texture_rgbm"])"));
    const Json& image = result.json["images"][1];
    const Json& view = result.json["bufferViews"][image["bufferView"].get<size_t>()];
    EXPECT_EQ(result.binary.substr(view["byteOffset"], view["byteLength"]), "\7\7\7\7\7");
    EXPECT_EQ(result.json["extras"], gltf.json["extras"]);
    EXPECT_EQ(result.json["nodes"][0]["extras"], Json::parse(R"({"contribute_gi": true})"));
}

TEST(LightmapGlb, EmbedsBuffersAndImagesOfFiles) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", add_square(gltf)}});
    gltf.json["images"] = {{{"uri", "a%20b.png"}}};
    gltf.json["buffers"] = {{{"byteLength", gltf.binary.size()}, {"uri", "data.bin"}}};
    const TempFolder folder;
    folder.write("data.bin", gltf.binary);
    folder.write("a b.png", "\x89PNG...");
    const auto bytes = make_lightmap_glb(folder.write("s.gltf", gltf.json.dump()),
                                         {{kWhole}, {place(0)}, {}, 1.0});
    ASSERT_TRUE(bytes) << error_text(bytes.error());
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    EXPECT_EQ(text.find("uri"), std::string::npos);
    EXPECT_NE(text.find("\x89PNG..."), std::string::npos);
    EXPECT_NE(text.find(R"("mimeType":"image/png")"), std::string::npos);
    EXPECT_TRUE(read_gltf(folder.write("written.glb", text)));
}

TEST(LightmapGlb, RefusesAnimationsThatAreNotGltf) {
    GltfBuilder gltf;
    const size_t mesh = add_square(gltf);
    gltf.json["meshes"][mesh]["primitives"].push_back(gltf.primitive(mesh));
    gltf.add_root({{"mesh", mesh}});
    gltf.json["animations"] = Json::parse(R"([{"samplers": [{"input": 0, "output": 0}],
                                        "channels": [{"sampler": 0, "target": {"path": 7}}]}])");
    const std::string error = refusal(gltf, {{kWhole}, {place(0), place(0)}, {}, 1.0});
    EXPECT_NE(error.find("scene.glb: animation 0: channel 0: target/path is not a string (7)"),
              std::string::npos)
        << error;
}

TEST(LightmapGlb, RefusesLightmapsOfAnotherScene) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "wall"}, {"mesh", add_square(gltf)}});
    const std::vector<glm::vec2> triangle(kWhole.begin(), kWhole.begin() + 3);
    EXPECT_NE(refusal(gltf, {{triangle}, {place(0)}, {}, 1.0})
                  .find("node 0 \"wall\" has 2 triangles, its lightmap UVs have 1"),
              std::string::npos);
    EXPECT_NE(refusal(gltf, {{kWhole}, {place(0), place(0)}, {}, 1.0})
                  .find("has 1 instances, the lightmaps have 2"),
              std::string::npos);
}

TEST(LightmapGlb, ScenesThatAreNotReadStay) {
    GltfBuilder gltf;
    const size_t square = add_square(gltf);
    gltf.add_root({{"name", "day"}, {"mesh", square}});
    gltf.json["scenes"][1] = {{"name", "night"},
                              {"nodes",
                               {gltf.add("nodes", {{"name", "a"}, {"mesh", square}}),
                                gltf.add("nodes", {{"name", "b"}, {"mesh", add_square(gltf)}})}}};
    const TempFolder folder;
    const GltfLightmapPlace place{0, 0, glm::vec2(0.5f), glm::vec2(0.25f)};
    const GltfLightmaps lightmaps{{kWhole}, {{}, place}, {}, 1.0};
    const auto path = folder.write("scene.glb", gltf.glb());
    EXPECT_FALSE(make_lightmap_glb(path, lightmaps));  // the default scene has one instance
    const auto bytes = make_lightmap_glb(path, lightmaps, {.scene = "night"});
    ASSERT_TRUE(bytes) << error_text(bytes.error());
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    uint32_t length = 0;
    std::memcpy(&length, text.data() + 12, sizeof length);
    const Json json = Json::parse(text.substr(20, length));
    EXPECT_EQ(json["scene"], 0);
    EXPECT_EQ(json["scenes"], gltf.json["scenes"]);
    EXPECT_EQ(json["nodes"][0], gltf.json["nodes"][0]);
    EXPECT_EQ(json["nodes"][1], gltf.json["nodes"][1]);
    EXPECT_TRUE(json["nodes"][2]["extras"].contains("lightmap_rectangle"));
}

TEST(LightmapGlb, ThePoseIsThatOfTheReading) {
    GltfBuilder gltf;
    const size_t square = add_square(gltf);
    gltf.add_root({{"name", "still"}, {"mesh", square}});
    gltf.add_root({{"name", "hidden"}, {"mesh", square}});
    const Json sampler = {{"input", gltf.add_floats({0, 1}, "SCALAR")},
                          {"output", gltf.add_floats({1, 1, 1, 0, 0, 0}, "VEC3")}};
    const Json channel = {{"sampler", 0}, {"target", {{"node", 1}, {"path", "scale"}}}};
    gltf.add("animations", {{"samplers", {sampler}}, {"channels", {channel}}});
    const TempFolder folder;
    const GltfLightmapPlace place{0, 0, glm::vec2(0.5f), glm::vec2(0.25f)};
    const auto path = folder.write("scene.glb", gltf.glb());
    EXPECT_FALSE(make_lightmap_glb(path, {{kWhole}, {place}, {}, 1.0}));
    EXPECT_TRUE(make_lightmap_glb(path, {{kWhole}, {place}, {}, 1.0}, {.time = 1.0}));
    EXPECT_TRUE(make_lightmap_glb(path, {{kWhole}, {place, place}, {}, 1.0}, {.time = 0.5}));
}

TEST(LightmapGlb, MeshesScaledTo0StayAndHaveNoPlaces) {
    GltfBuilder gltf;
    const size_t square = add_square(gltf);
    gltf.add_root({{"name", "hidden"}, {"mesh", square}, {"scale", {0, 1, 1}}});
    gltf.add_root({{"name", "seen"}, {"mesh", square}});
    const Json attributes = {{"SCALE", gltf.add_floats({0, 0, 0, 1, 1, 1}, "VEC3")}};
    gltf.add_root({{"name", "trees"},
                   {"mesh", square},
                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    const GltfLightmapPlace place{0, 0, glm::vec2(0.5f), glm::vec2(0.25f)};
    const Written result = written(gltf, {{kWhole}, {place, place}, {}, 1.0});
    EXPECT_EQ(result.scene.instances.size(), 2u);
    const Json& nodes = result.json["nodes"];
    EXPECT_TRUE(nodes[0].contains("mesh"));
    EXPECT_FALSE(nodes[0].contains("extras"));
    EXPECT_TRUE(nodes[1]["extras"].contains("lightmap_rectangle"));
    ASSERT_EQ(nodes[2]["children"].size(), 2u);
    EXPECT_FALSE(nodes[nodes[2]["children"][0].get<size_t>()].contains("extras"));
    EXPECT_TRUE(
        nodes[nodes[2]["children"][1].get<size_t>()]["extras"].contains("lightmap_rectangle"));
}

}  // namespace
}  // namespace tetralight
