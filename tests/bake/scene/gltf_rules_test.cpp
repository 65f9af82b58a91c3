// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_rules.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// One element of each kind, joined by indices that are all in range.
GltfBuilder linked_scene() {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["indices"] =
        gltf.add_accessor(std::vector<uint16_t>{0, 1, 2}, "SCALAR", 5123);
    gltf.primitive(mesh)["material"] =
        gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                               {"emissiveTexture", {{"index", 0}}},
                               {"normalTexture", {{"index", 0}}}});
    gltf.add("textures", {{"sampler", 0}});
    gltf.add("samplers", Json::object());
    gltf.add("images", {{"bufferView", 0}});
    gltf.add("skins", {{"joints", {0}}});
    const size_t light = gltf.add_light({{"type", "point"}});
    const size_t child = gltf.add("nodes", {{"extensions", GltfBuilder::light_extension(light)}});
    const Json instancing = {{"TRANSLATION", gltf.add_floats({0, 0, 0}, "VEC3")}};
    gltf.add_root({{"mesh", mesh},
                   {"skin", 0},
                   {"children", {child}},
                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", instancing}}}}}});
    gltf.json["buffers"] = {{{"byteLength", gltf.binary.size()}}};
    gltf.json["accessors"].push_back({{"componentType", 5126},
                                      {"count", 1},
                                      {"type", "VEC3"},
                                      {"sparse",
                                       {{"count", 1},
                                        {"indices", {{"bufferView", 0}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}}}}}});
    return gltf;
}

TEST(GltfRules, LinkedSceneIsRead) {
    const auto scene = linked_scene().read();
    EXPECT_TRUE(scene) << error_text(scene.error());
}

/// JSON pointers of all indices in linked_scene().
const char* const kIndexPointers[] = {
    "/scene",
    "/scenes/0/nodes/0",
    "/nodes/1/mesh",
    "/nodes/1/skin",
    "/nodes/1/children/0",
    "/nodes/0/extensions/KHR_lights_punctual/light",
    "/nodes/1/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION",
    "/meshes/0/primitives/0/attributes/POSITION",
    "/meshes/0/primitives/0/indices",
    "/meshes/0/primitives/0/material",
    "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
    "/materials/0/emissiveTexture/index",
    "/materials/0/normalTexture/index",
    "/textures/0/sampler",
    "/textures/0/source",
    "/images/0/bufferView",
    "/accessors/0/bufferView",
    "/accessors/3/sparse/indices/bufferView",
    "/accessors/3/sparse/values/bufferView",
    "/bufferViews/0/buffer",
};

class GltfIndex : public testing::TestWithParam<const char*> {};

TEST_P(GltfIndex, OutOfRangeIsAnErrorThatNamesIt) {
    // 2^32 and 2^32 + 1 become 0 and 1 where 32 bits are cut off.
    for (const int64_t value :
         {int64_t{99}, int64_t{-1}, int64_t{1} << 32, (int64_t{1} << 32) + 1}) {
        GltfBuilder gltf = linked_scene();
        gltf.json[Json::json_pointer(GetParam())] = value;
        const std::string error = gltf.error();
        EXPECT_NE(error.find(std::to_string(value) + " is out of range ("), std::string::npos)
            << error;
    }
}

TEST_P(GltfIndex, OfAnotherTypeIsAnError) {
    for (const Json& value : {Json("0"), Json(0.5), Json(), Json(true), Json::array()}) {
        GltfBuilder gltf = linked_scene();
        gltf.json[Json::json_pointer(GetParam())] = value;
        EXPECT_NE(gltf.error(), "(no error)") << value;
    }
}

INSTANTIATE_TEST_SUITE_P(All, GltfIndex, testing::ValuesIn(kIndexPointers),
                         [](const auto& param_info) {
                             std::string label = param_info.param;
                             for (char& c : label) {
                                 if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                             }
                             return label;
                         });

TEST(GltfRules, EveryPropertyOfTheWrongTypeIsAnError) {
    for (const auto& section : detail::gltf_sections()) {
        if (std::string(section.name) == "skins" || std::string(section.name) == "lights") continue;
        for (const auto& rule : section.rules) {
            std::string pointer = std::string("/") + section.path + "/0/" + rule.path;
            GltfBuilder gltf = linked_scene();
            // An array of an array is right for none of the kinds.
            gltf.json[Json::json_pointer(pointer)] = Json::array({Json::array()});
            EXPECT_NE(gltf.error(), "(no error)") << pointer;
        }
    }
}

TEST(GltfRules, RequiredPropertiesAreRequired) {
    for (const char* pointer :
         {"/accessors/0/componentType", "/accessors/0/count", "/accessors/0/type",
          "/bufferViews/0/byteLength", "/buffers/0/byteLength", "/asset/version",
          "/meshes/0/primitives", "/meshes/0/primitives/0/attributes"}) {
        GltfBuilder gltf = linked_scene();
        const Json::json_pointer path(pointer);
        gltf.json[path.parent_pointer()].erase(path.back());
        EXPECT_NE(gltf.error().find("missing"), std::string::npos) << pointer << gltf.error();
    }
}

TEST(GltfRules, NamesTheElementAndTheValue) {
    GltfBuilder gltf = linked_scene();
    gltf.json["nodes"][1]["name"] = "wall";
    gltf.json["nodes"][1]["mesh"] = 9999;
    EXPECT_EQ(gltf.error(), "scene.glb: node 1 \"wall\": mesh 9999 is out of range (1 meshes)");
}

TEST(GltfRules, ExtensionsAreObjects) {
    const auto error_with = [](const char* pointer, const Json& value) {
        GltfBuilder gltf;
        gltf.add_root({{"name", "lamp"}});
        gltf.json[Json::json_pointer(pointer)] = value;
        return gltf.error();
    };
    EXPECT_EQ(error_with("/nodes/0/extensions", Json::array()),
              "scene.glb: node 0 \"lamp\": extensions is not an object ([])");
    EXPECT_EQ(error_with("/nodes/0/extensions", nullptr),
              "scene.glb: node 0 \"lamp\": extensions is not an object (null)");
    EXPECT_EQ(error_with("/nodes/0/extensions", {{"KHR_lights_punctual", {0}}}),
              "scene.glb: node 0 \"lamp\": extensions/KHR_lights_punctual is not an object ([0])");
    EXPECT_EQ(error_with("/extensions", "x"), "scene.glb: extensions is not an object (\"x\")");
    EXPECT_EQ(error_with("/extensionsUsed", {1}),
              "scene.glb: extensionsUsed is not a list of names ([1])");
    EXPECT_EQ(error_with("/extensionsRequired", "KHR_draco_mesh_compression"),
              "scene.glb: extensionsRequired is not a list of names "
              "(\"KHR_draco_mesh_compression\")");
    EXPECT_EQ(error_with("/asset/version", 2.0), "scene.glb: asset.version is not a string (2.0)");
    // Extensions of others may be anything.
    EXPECT_EQ(error_with("/nodes/0/extensions", {{"ACME_tag", 1}}), "(no error)");
}

TEST(GltfRules, NamesThePlaceInAList) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "wall"}, {"children", {12345}}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"wall\": children[0] 12345 is out of range (1 nodes)");
}

TEST(GltfRules, FilesOfOtherKindsAreToldByWhatTheyBeginWith) {
    const TempFolder folder;
    const auto message = [&](const std::string& text) {
        const auto scene = read_gltf(folder.write("scene.gltf", text));
        return scene ? "(no error)" : error_text(scene.error()).substr(folder.path("").size());
    };
    EXPECT_EQ(message(""), "scene.gltf: is not glTF: it is empty");
    EXPECT_EQ(message(" \n"), "scene.gltf: is not glTF: it is empty");
    EXPECT_EQ(message("version https://git-lfs.github.com/spec/v1\noid"),
              "scene.gltf: is not glTF: it begins with \"version https://git-lfs.\"");
    // Two blanks before, and a mark of byte order.
    EXPECT_EQ(message("\xef\xbb\xbf  {\"asset\": {\"version\": \"2.0\"}}"), "(no error)");
}

TEST(GltfRules, ExtrasMayBeAnything) {
    for (const Json& extras : {Json("text"), Json(1), Json::array({1, 2}), Json({{"mode", 5}})}) {
        GltfBuilder gltf = linked_scene();
        gltf.json["nodes"][1]["extras"] = extras;
        EXPECT_EQ(gltf.error(), "(no error)") << extras;
    }
}

TEST(GltfRules, RejectsABufferViewOutsideOfItsBuffer) {
    for (const char* key : {"byteOffset", "byteLength"}) {
        GltfBuilder gltf = linked_scene();
        gltf.json["bufferViews"][0][key] = 4294967295u;
        EXPECT_NE(gltf.error().find("scene.glb: buffer view 0: bytes "), std::string::npos)
            << gltf.error();
    }
}

TEST(GltfRules, RejectsUnknownRequiredExtensions) {
    GltfBuilder gltf = linked_scene();
    gltf.json["extensionsRequired"] = {"KHR_texture_transform", "X"};
    EXPECT_EQ(gltf.error(), "scene.glb: required extension \"X\" is not supported");
}

TEST(GltfRules, SaysWhatToDoAboutRequiredExtensions) {
    const std::map<std::string, std::string> remedies{
        {"EXT_texture_avif", "`gltf-transform png --formats avif` makes PNG images of AVIF images"},
        {"KHR_techniques_webgl", "`gltf-pipeline -i IN.glb -o OUT.glb` turns them into materials"},
        {"MSFT_texture_dds", "export the images as PNG or JPEG files"}};
    for (const auto& [extension, remedy] : remedies) {
        GltfBuilder gltf = linked_scene();
        gltf.json["extensionsRequired"] = {extension};
        gltf.json["textures"][0]["extensions"][extension] = {{"source", 0}};
        EXPECT_EQ(gltf.error(), "scene.glb: required extension \"" + extension +
                                    "\" is not supported; " + remedy);
    }
}

TEST(GltfRules, ImagesThatAreNotReadMayBeRequiredBesideOthers) {
    for (const char* extension : {"EXT_texture_avif", "MSFT_texture_dds"}) {
        GltfBuilder gltf = linked_scene();
        gltf.json["extensionsRequired"] = {extension};
        EXPECT_EQ(gltf.error(), "(no error)") << extension;
        Json& texture = gltf.json["textures"][0];
        texture["extensions"][extension] = {{"source", 0}};
        EXPECT_NE(gltf.error().find("required extension"), std::string::npos) << extension;
        texture["extensions"]["EXT_texture_webp"] = {{"source", 0}};
        EXPECT_EQ(gltf.error().find("required extension"), std::string::npos) << extension;
    }
}

TEST(GltfRules, ExtensionsThatLeaveDiffuseLightAloneMayBeRequired) {
    for (const char* name :
         {"KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_dispersion",
          "KHR_materials_ior", "KHR_materials_iridescence", "KHR_materials_sheen",
          "KHR_materials_specular", "KHR_materials_variants"}) {
        GltfBuilder gltf = linked_scene();
        gltf.json["extensionsRequired"] = {name};
        gltf.json["materials"][0]["extensions"][name] = Json::object();
        const auto scene = gltf.read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        const auto row = std::ranges::find(scene->parts, name, &ScenePart::name);
        ASSERT_NE(row, scene->parts.end()) << name;
        EXPECT_NE(row->use, PartUse::Read) << name;
    }
}

TEST(GltfRules, RejectsOtherVersions) {
    GltfBuilder gltf = linked_scene();
    gltf.json["asset"]["version"] = "1.0";
    EXPECT_EQ(gltf.error(),
              "scene.glb: asset.version \"1.0\" is not supported (2.x is); `gltf-pipeline -i "
              "IN.gltf -o OUT.glb` makes it glTF 2.0");
    gltf.json["asset"]["version"] = "3.0";
    EXPECT_EQ(gltf.error(), "scene.glb: asset.version \"3.0\" is not supported (2.x is)");
}

TEST(GltfRules, ALaterMinorVersionIsReadUnlessTheFileNeedsIt) {
    GltfBuilder gltf = linked_scene();
    gltf.json["asset"]["version"] = "2.1";
    EXPECT_EQ(gltf.error(), "(no error)");
    gltf.json["asset"]["minVersion"] = "2.0";
    EXPECT_EQ(gltf.error(), "(no error)");
    gltf.json["asset"]["minVersion"] = "2.1";
    EXPECT_EQ(gltf.error(),
              "scene.glb: asset.minVersion \"2.1\" is not supported (2.0 is); export the file as "
              "glTF 2.0");
    gltf.json["asset"]["minVersion"] = 2;
    EXPECT_EQ(gltf.error(), "scene.glb: asset.minVersion is not a string (2)");
}

TEST(GltfRules, RejectsAMatrixBesideItsParts) {
    for (const char* part : {"translation", "rotation", "scale"}) {
        GltfBuilder gltf = linked_scene();
        Json& node = gltf.json["nodes"][1];
        node["name"] = "wall";
        node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        EXPECT_EQ(gltf.error(), "(no error)");
        node[part] = std::string(part) == "rotation" ? Json{0, 0, 0, 1} : Json{1, 1, 1};
        EXPECT_EQ(gltf.error(), std::string("scene.glb: node 1 \"wall\": has a matrix beside a ") +
                                    part + "; glTF allows one of them, so remove the other");
    }
}

TEST(GltfRules, RejectsASecondBufferWithoutUri) {
    GltfBuilder gltf = linked_scene();
    gltf.add("buffers", {{"byteLength", 4}});
    EXPECT_EQ(gltf.error(), "scene.glb: buffer 1: has no uri");
}

TEST(GltfRules, RejectsDeepNesting) {
    GltfBuilder gltf = linked_scene();
    Json deep = 1;
    for (int i = 0; i < 100; ++i) deep = Json::array({deep});
    gltf.json["extras"] = deep;
    EXPECT_EQ(gltf.error(), "scene.glb: JSON is nested deeper than 64");
}

TEST(GltfRules, RejectsNestingThatWouldEndTheStack) {
    const TempFolder folder;
    const std::string text = std::string(1000000, '[') + std::string(1000000, ']');
    EXPECT_FALSE(read_gltf(folder.write("scene.gltf", text)));
}

}  // namespace
}  // namespace tetralight
