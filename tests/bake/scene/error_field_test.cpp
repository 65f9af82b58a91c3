// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/error_field.h>

#include <gtest/gtest.h>

#include <tetralight/bake/scene/probe_adjustments_json.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include "tests/bake/scene/gltf_builder.h"

// Errors of the readers name the member that is at fault, its value and a code.

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// A scene of a triangle with a material, a light and a texture, which a test changes.
GltfBuilder small_scene() {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["material"] = gltf.add("materials", Json::object());
    const size_t light = gltf.add_light({{"type", "point"}});
    gltf.add_root({{"mesh", mesh}});
    gltf.add_root({{"extensions", GltfBuilder::light_extension(light)}});
    gltf.add("images", {{"uri", "missing.png"}});
    gltf.add("textures", {{"source", 0}});
    return gltf;
}

struct GltfFault {
    const char* name;
    const char* pointer;  ///< of what is changed
    Json value;
    ErrorCode code;
    const char* field;
    const char* shown;
};

class GltfErrorField : public testing::TestWithParam<GltfFault> {};

TEST_P(GltfErrorField, NamesTheMemberAndItsValue) {
    GltfBuilder gltf = small_scene();
    gltf.json[Json::json_pointer(GetParam().pointer)] = GetParam().value;
    const auto scene = gltf.read();
    ASSERT_FALSE(scene);
    EXPECT_EQ(error_code_name(scene.error().code), error_code_name(GetParam().code));
    EXPECT_EQ(scene.error().field, GetParam().field);
    EXPECT_EQ(scene.error().value, GetParam().shown);
}

using enum ErrorCode;

INSTANTIATE_TEST_SUITE_P(
    Members, GltfErrorField,
    testing::Values(
        GltfFault{"Material", "/materials/0/alphaCutoff", -2, Corrupt, "materials[0].alphaCutoff",
                  "-2"},
        GltfFault{"WrongType",
                  "/nodes/0/extras",
                  {{"dering", "x"}},
                  Corrupt,
                  "nodes[0].extras.dering",
                  "\"x\""},
        GltfFault{"LayersOfAGroup",
                  "/nodes/0/extras",
                  {{"rendering_layers", {0, 32}}},
                  Corrupt,
                  "nodes[0].extras.rendering_layers",
                  "[0,32]"},
        GltfFault{"LayersOfAnAdjustment",
                  "/nodes/0/extras",
                  {{"probe_adjustment", {{"shape", "box"}, {"rendering_layers", Json::array()}}}},
                  Corrupt,
                  "nodes[0].extras.probe_adjustment.rendering_layers",
                  "[]"},
        GltfFault{"Index", "/nodes/0/mesh", 9, Corrupt, "nodes[0].mesh", "9"},
        GltfFault{"Primitive", "/meshes/0/primitives/0/mode", 99, Corrupt,
                  "meshes[0].primitives[0].mode", "99"},
        GltfFault{"AccessorOfAMesh", "/accessors/0/count", 0, Corrupt, "accessors[0].count", "0"},
        GltfFault{"Light", "/extensions/KHR_lights_punctual/lights/0/intensity", -1, Corrupt,
                  "extensions.KHR_lights_punctual.lights[0].intensity", "-1"},
        GltfFault{"ExtrasOfALight",
                  "/extensions/KHR_lights_punctual/lights/0/extras",
                  {{"mode", "none"}},
                  InvalidArgument,
                  "extensions.KHR_lights_punctual.lights[0].extras.mode",
                  "none"},
        GltfFault{"LightExtrasOfANode",
                  "/nodes/1/extras",
                  {{"radius", -3}},
                  InvalidArgument,
                  "nodes[1].extras.radius",
                  "-3"},
        GltfFault{"Adjustment",
                  "/nodes/0/extras",
                  {{"probe_adjustment", {{"shape", "box"}, {"spacing", -1}}}},
                  InvalidArgument,
                  "nodes[0].extras.probe_adjustment.spacing",
                  "-1"},
        GltfFault{"AnchorThatIsMissing",
                  "/nodes/0/extras",
                  {{"probe_anchor", "door"}},
                  NotFound,
                  "nodes[0].extras.probe_anchor",
                  "door"},
        GltfFault{"RequiredExtension",
                  "/extensionsRequired",
                  {"EXT_of_the_future"},
                  Unsupported,
                  "extensionsRequired",
                  "\"EXT_of_the_future\""},
        GltfFault{"ImageFileThatIsMissing",
                  "/materials/0/pbrMetallicRoughness",
                  {{"baseColorTexture", {{"index", 0}}}},
                  NotFound,
                  "images[0].uri",
                  "missing.png"},
        GltfFault{"BufferFileThatIsMissing", "/buffers",
                  Json::array({{{"uri", "missing.bin"}, {"byteLength", 36}}}), NotFound,
                  "buffers[0].uri", ""}),
    [](const auto& fault) { return fault.param.name; });

TEST(ErrorField, OfAProbeGroupFileNamesTheGroupAndTheProbe) {
    const TempFolder folder;
    const auto field_of = [&](const std::string& text) {
        const auto groups = read_probe_groups(folder.write("g.json", text));
        return groups ? std::string("(no error)") : groups.error().field;
    };
    const std::string first = R"({"groups": [{"name": "a", "positions": []}, )";
    EXPECT_EQ(field_of(first + R"({"name": "b", "positions": [[1, 2, 3], [4, "x", 6]]}]})"),
              "groups[1].positions[1][1]");
    EXPECT_EQ(field_of(first + R"({"name": "b", "positions": [[1, 2]]}]})"),
              "groups[1].positions[0]");
    EXPECT_EQ(field_of(first + R"({"name": "b", "dering": 1, "positions": []}]})"),
              "groups[1].dering");
    EXPECT_EQ(field_of(first + R"({"name": "b", "rendering_layers": [32], "positions": []}]})"),
              "groups[1].rendering_layers");
    EXPECT_EQ(field_of(first + R"({"name": "a", "positions": []}]})"), "groups[1].name");
    EXPECT_EQ(field_of(first + R"({"name": "b", "positions": [[1, 2, 3], [NaN)"),
              "groups[1].positions[1]");
    EXPECT_EQ(field_of(R"({"groups": 7})"), "groups");
}

TEST(ErrorField, OfAnAdjustmentFileNamesTheVolumeAndTheKey) {
    const TempFolder folder;
    const std::string text = R"({"adjustments": [{"name": "a", "shape": "box", "forbid": true},
                                                 {"name": "b", "shape": "box", "validity": 2}]})";
    const auto adjustments = read_probe_adjustments(folder.write("a.json", text));
    ASSERT_FALSE(adjustments);
    EXPECT_EQ(adjustments.error().code, InvalidArgument);
    EXPECT_EQ(adjustments.error().field, "adjustments[1].validity");
    EXPECT_EQ(adjustments.error().value, "2");
}

TEST(ErrorField, ProbeGroupIndexIsThatOfTheField) {
    EXPECT_EQ(probe_group_index("groups[12].positions[7]"), 12u);
    EXPECT_EQ(probe_group_index("groups[0]"), 0u);
    EXPECT_EQ(probe_group_index("groups"), std::nullopt);
    EXPECT_EQ(probe_group_index("groups[]"), std::nullopt);
    EXPECT_EQ(probe_group_index("nodes[1]"), std::nullopt);
}

TEST(ErrorField, RelativeFieldsAreCompletedAndOthersStay) {
    const auto field_in = [](const char* field, const char* member) {
        return detail::in_member({ErrorCode::Corrupt, field, "", "bad"}, member).field;
    };
    EXPECT_EQ(field_in(".extras", "nodes[3]"), "nodes[3].extras");
    EXPECT_EQ(field_in("[7]", ".positions"), ".positions[7]");
    EXPECT_EQ(field_in("", "nodes[3]"), "nodes[3]");
    EXPECT_EQ(field_in("images[1].uri", "nodes[3]"), "images[1].uri");
    EXPECT_EQ(field_in(".groups", ""), "groups");
}

}  // namespace
}  // namespace tetralight
