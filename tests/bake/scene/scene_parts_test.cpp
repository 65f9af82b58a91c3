// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/scene_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/length_unit.h>
#include <tetralight/base/str_cat.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = GltfBuilder::Json;

/// A triangle with a material, and a light.
GltfBuilder plain_scene() {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["material"] = gltf.add("materials", {{"name", "paint"}});
    gltf.add_root({{"name", "wall"}, {"mesh", mesh}});
    const size_t light = gltf.add_light({{"name", "bulb"}, {"type", "point"}});
    gltf.add_root({{"name", "lamp"}, {"extensions", GltfBuilder::light_extension(light)}});
    return gltf;
}

Scene read(const GltfBuilder& gltf, const SceneReading& reading = {}) {
    auto scene = gltf.read(reading);
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    return scene ? *scene : Scene();
}

/// The part of this name; an empty one if there is none.
ScenePart part(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.parts, name, &ScenePart::name);
    return found == scene.parts.end() ? ScenePart() : *found;
}

/// The warnings, without the path before them.
std::vector<std::string> warnings(const Scene& scene) {
    std::vector<std::string> lines;
    for (const std::string& warning : scene.warnings) {
        lines.push_back(warning.substr(warning.find("scene.glb: ") + 11));
    }
    return lines;
}

TEST(SceneParts, CountsAndNamesWhatIsRead) {
    const Scene scene = read(plain_scene());
    EXPECT_EQ(part(scene, "triangles").count, 1u);
    EXPECT_EQ(part(scene, "static objects").elements, std::vector<std::string>{"\"wall\""});
    EXPECT_EQ(part(scene, "materials").elements, std::vector<std::string>{"\"paint\""});
    EXPECT_EQ(part(scene, "point lights").elements, std::vector<std::string>{"\"lamp\""});
    EXPECT_EQ(part(scene, "moving objects"), ScenePart());
    EXPECT_TRUE(scene.warnings.empty());
    for (const ScenePart& row : scene.parts) {
        EXPECT_EQ(row.use, PartUse::Read) << row.name;
        EXPECT_FALSE(row.changes_light) << row.name;
    }
}

TEST(SceneParts, NamesAtMostSomeElementsOfMany) {
    GltfBuilder gltf = plain_scene();
    for (int i = 0; i < 20; ++i) gltf.add_root({{"name", "w"}, {"mesh", 0}});
    const ScenePart row = part(read(gltf), "static objects");
    EXPECT_EQ(row.count, 21u);
    EXPECT_EQ(row.elements.size(), ScenePart::kMaxElements);
}

/// Something in a file that changes the light and that is not read.
struct Unread {
    const char* name;
    /// Where in the document, and what.
    const char* pointer;
    Json value;
    const char* warning;
};

void PrintTo(const Unread& unread, std::ostream* stream) {
    *stream << unread.name;
}

class ScenePartsWarn : public testing::TestWithParam<Unread> {};

TEST_P(ScenePartsWarn, OfWhatChangesTheLightAndIsNotRead) {
    GltfBuilder gltf = plain_scene();
    gltf.json[Json::json_pointer(GetParam().pointer)] = GetParam().value;
    const Scene scene = read(gltf);
    EXPECT_EQ(warnings(scene), std::vector<std::string>{GetParam().warning});
    const auto row = std::ranges::find(scene.parts, true, &ScenePart::changes_light);
    ASSERT_NE(row, scene.parts.end());
    EXPECT_EQ(row->use, PartUse::Ignored);
    EXPECT_EQ(row->count, 1u);
}

INSTANTIATE_TEST_SUITE_P(
    All, ScenePartsWarn,
    testing::Values(
        Unread{"CamelCase",
               "/nodes/0/extras",
               {{"contributeGI", false}},
               "extras \"contributeGI\" (node 0 \"wall\"): is no name that Tetralight reads; did "
               "you mean \"contribute_gi\"?"},
        Unread{"Dashes",
               "/nodes/0/extras",
               {{"Light-Probe-Group", true}},
               "extras \"Light-Probe-Group\" (node 0 \"wall\"): is no name that Tetralight reads; "
               "did you mean \"light_probe_group\"?"},
        Unread{"OneLetter",
               "/nodes/0/extras",
               {{"lightmap_scal", 2}},
               "extras \"lightmap_scal\" (node 0 \"wall\"): is no name that Tetralight reads; did "
               "you mean \"lightmap_scale\"?"},
        Unread{"OfTheMesh",
               "/meshes/0/extras",
               {{"contribute_gi", false}},
               "extras \"contribute_gi\" (mesh 0): is read of nodes only; move it to the extras "
               "of nodes"},
        Unread{"OfTheFile",
               "/extras",
               {{"sky", {{"radiance", {1, 1, 1}}}}},
               "extras \"sky\" (the file): is read of scenes only; move it to the extras of "
               "scenes"},
        Unread{"SkyOfANode",
               "/nodes/0/extras",
               {{"sky", {{"radiance", {1, 1, 1}}}}},
               "extras \"sky\" (node 0 \"wall\"): is read of scenes only; move it to the extras "
               "of scenes"},
        Unread{"OfALight",
               "/nodes/0/extras",
               {{"indirect_multiplier", 2}},
               "extras \"indirect_multiplier\" (node 0 \"wall\"): is read of nodes with a light "
               "only"},
        Unread{"OfAProbeGroup",
               "/nodes/0/extras",
               {{"dering", true}},
               "extras \"dering\" (node 0 \"wall\"): is read of probe groups only"},
        Unread{"Attribute", "/meshes/0/primitives/0/attributes/TEXCORD_0", 0,
               "attribute TEXCORD_0 (mesh 0): is not an attribute of glTF 2.0; did you mean "
               "\"TEXCOORD_0\"?"},
        Unread{"MemberOfAnExtension",
               "/materials/0/extensions",
               {{"KHR_materials_pbrSpecularGlossiness", {{"difuseFactor", {1, 1, 1, 1}}}}},
               "member \"difuseFactor\" of KHR_materials_pbrSpecularGlossiness (material 0 "
               "\"paint\"): is not defined; did you mean \"diffuseFactor\"?"},
        Unread{"ExtrasOfALightBesideThem", "/extensions/KHR_lights_punctual/lights/0/radius", 0.5,
               "member \"radius\" of lights (light 0 \"bulb\"): is read of \"extras\" only; move "
               "it into "
               "\"extras\""},
        Unread{"SkyMember",
               "/scenes/0/extras",
               {{"sky", {{"radiance", {1, 1, 1}}, {"rotation", 90}}}},
               "extras.sky \"rotation\" (scene 0): is no member that Tetralight reads; "
               "docs/scenes.md lists the members"},
        Unread{"ReflectionProbeMember",
               "/nodes/0/extras",
               {{"reflection_probe", {{"blendDistance", 1}}}},
               "extras.reflection_probe \"blendDistance\" (node 0 \"wall\"): is no member that "
               "Tetralight reads; did you mean \"blend_distance\"?"},
        Unread{"AdjustmentMember",
               "/nodes/0/extras",
               {{"probe_adjustment",
                 {{"shape", "box"}, {"size", {1, 1, 1}}, {"spacing", 1}, {"forbids", true}}}},
               "extras.probe_adjustment \"forbids\" (node 0 \"wall\"): is no member that "
               "Tetralight reads; did you mean \"forbid\"?"},
        Unread{"Volume",
               "/materials/0/extensions",
               {{"KHR_materials_volume", {{"thicknessFactor", 1}}}},
               "KHR_materials_volume (material 0 \"paint\"): light that shines through is not "
               "absorbed"},
        Unread{"UnknownExtension",
               "/materials/0/extensions",
               {{"ACME_glow", {{"power", 1}}}},
               "ACME_glow (material 0 \"paint\"): is not known here; what it changes of surfaces "
               "and lights is left out"},
        Unread{"MisspeltMember",
               "/materials/0/pbrMetallicRoughness",
               {{"baseColourFactor", {0, 0, 1, 1}}},
               "member \"baseColourFactor\" of pbrMetallicRoughness (material 0 \"paint\"): is not "
               "defined; did you mean \"baseColorFactor\"?"},
        Unread{"MemberOfAPartOfTheElement",
               "/materials/0/baseColorFactor",
               {0, 0, 1, 1},
               "member \"baseColorFactor\" of materials (material 0 \"paint\"): is a member of "
               "pbrMetallicRoughness; move it to pbrMetallicRoughness"},
        Unread{"MemberOfAnotherElement", "/meshes/0/material", 0,
               "member \"material\" of meshes (mesh 0): is a member of primitives; move it to "
               "primitives"},
        Unread{"MisspeltMemberOfALight", "/extensions/KHR_lights_punctual/lights/0/intensty", 5,
               "member \"intensty\" of lights (light 0 \"bulb\"): is not defined; did you mean "
               "\"intensity\"?"},
        Unread{"ExtensionBesideTheExtensions",
               "/materials/0/KHR_materials_emissive_strength",
               {{"emissiveStrength", 9}},
               "member \"KHR_materials_emissive_strength\" of materials (material 0 \"paint\"): is "
               "an extension outside of \"extensions\"; move it into \"extensions\""},
        Unread{"ExtrasBesideTheExtras", "/nodes/0/contribute_gi", false,
               "member \"contribute_gi\" of nodes (node 0 \"wall\"): is read of \"extras\" only; "
               "move it into \"extras\""},
        Unread{"UnknownExtensionOfTheFile",
               "/extensionsUsed",
               {"ACME_fog"},
               "ACME_fog (the file): is not known here; what it changes of surfaces and lights is "
               "left out"}),
    [](const auto& instance) { return std::string(instance.param.name); });

/// Something in a file that is not read and does not change the light.
class ScenePartsTell : public testing::TestWithParam<Unread> {};

TEST_P(ScenePartsTell, WithoutAWarning) {
    GltfBuilder gltf = plain_scene();
    gltf.json[Json::json_pointer(GetParam().pointer)] = GetParam().value;
    const Scene scene = read(gltf);
    EXPECT_EQ(warnings(scene), std::vector<std::string>());
    const ScenePart row = part(scene, GetParam().warning);
    EXPECT_NE(row.use, PartUse::Read);
    EXPECT_EQ(row.count, 1u);
    EXPECT_FALSE(row.note.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, ScenePartsTell,
    testing::Values(
        Unread{"OtherExtras", "/nodes/0/extras", {{"cycles_visibility", 3}}, "other extras"},
        Unread{"CommonWord", "/materials/0/extras", {{"width", 3}}, "other extras"},
        Unread{"Clearcoat",
               "/materials/0/extensions",
               {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}},
               "KHR_materials_clearcoat"},
        Unread{"SpecularGlossiness",
               "/materials/0/extensions",
               {{"KHR_materials_pbrSpecularGlossiness", Json::object()}},
               "KHR_materials_pbrSpecularGlossiness"},
        Unread{"Transmission",
               "/materials/0/extensions",
               {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}},
               "KHR_materials_transmission"},
        Unread{"ExtensionOfATexture",
               "/materials/0/occlusionTexture",
               {{"index", 0}, {"extensions", {{"EXT_mesh_features", Json::object()}}}},
               "EXT_mesh_features"},
        Unread{"OcclusionTexture",
               "/materials/0/occlusionTexture",
               {{"index", 0}},
               "occlusion textures"},
        Unread{"Lines",
               "/meshes/0/primitives/1",
               {{"attributes", {{"POSITION", 0}}}, {"mode", 1}},
               "lines"},
        Unread{"OtherColors", "/meshes/0/primitives/0/attributes/COLOR_1", 0, "attribute COLOR_1"},
        Unread{"OwnAttribute", "/meshes/0/primitives/0/attributes/_ID", 0, "attribute _ID"},
        Unread{"OtherMember", "/nodes/0/visibility_of_cycles", true, "other members"},
        Unread{"OtherMemberOfAPrimitive", "/meshes/0/primitives/0/name", "a", "other members"},
        Unread{"MisspeltMemberWithoutLight", "/asset/generatr", "pen",
               "member \"generatr\" of asset"},
        Unread{"DdsAlone",
               "/textures/0",
               {{"extensions", {{"MSFT_texture_dds", {{"source", 0}}}}}},
               "MSFT_texture_dds"},
        Unread{"OtherScene", "/scenes/1", {{"name", "attic"}}, "other scenes"},
        Unread{"OtherNode", "/nodes/2", {{"name", "lost"}}, "nodes outside of the scene"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(SceneParts, SaysWhichImageOfATextureIsRead) {
    for (const char* name : {"EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"}) {
        GltfBuilder gltf = plain_scene();
        gltf.add("images", {{"uri", "a.png"}});
        gltf.add("textures", {{"extensions", {{name, {{"source", 0}}}}}});
        EXPECT_EQ(part(read(gltf), name).note,
                  "there is no PNG, JPEG or WebP image beside it; the texture is left out");
        gltf.json["textures"][0]["source"] = 0;
        EXPECT_EQ(part(read(gltf), name).note, "the texture's PNG, JPEG or WebP image is read");
    }
}

TEST(SceneParts, AWordOnSeveralElementsIsOneWarning) {
    GltfBuilder gltf = plain_scene();
    for (const size_t node : {0, 1}) gltf.json["nodes"][node]["extras"] = {{"walkabel", true}};
    EXPECT_EQ(warnings(read(gltf)),
              std::vector<std::string>{"extras \"walkabel\" (node 0 \"wall\" and 1 more): is no "
                                       "name that Tetralight reads; did you mean \"walkable\"?"});
}

TEST(SceneParts, BooleansOfExtrasMayBeBits) {
    GltfBuilder gltf = plain_scene();
    gltf.json["nodes"][0]["extras"] = {{"contribute_gi", 0}, {"walkable", 1}};
    gltf.json["materials"][0]["extras"] = {{"bake_emission", 0}};
    const Scene scene = read(gltf);
    EXPECT_FALSE(scene.instances.at(0).contributes_gi);
    EXPECT_TRUE(scene.instances.at(0).is_walkable);
    EXPECT_FALSE(scene.materials.at(0).bakes_emission);
    EXPECT_EQ(part(scene, "moving objects").count, 1u);
}

TEST(SceneParts, HiddenNodesHideTheirChildrenAndLights) {
    GltfBuilder gltf = plain_scene();
    gltf.json["nodes"][0]["children"] = {gltf.add("nodes", {{"mesh", 0}, {"name", "child"}})};
    gltf.json["nodes"][2]["extensions"]["KHR_node_visibility"] = {{"visible", true}};
    EXPECT_EQ(read(gltf).instances.size(), 2u);
    for (const size_t node : {0, 1}) {
        gltf.json["nodes"][node]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
    }
    const Scene scene = read(gltf);
    EXPECT_EQ(scene.instances.size(), 0u);
    EXPECT_EQ(scene.lights.size(), 0u);
}

TEST(SceneParts, AnotherSceneIsReadByNameOrIndex) {
    GltfBuilder gltf = plain_scene();
    gltf.json["scenes"][0]["name"] = "hall";
    gltf.json["scenes"][1] = {
        {"name", "0"}, {"nodes", {1}}, {"extras", {{"sky", {{"radiance", {1, 2, 3}}}}}}};
    EXPECT_EQ(read(gltf).instances.size(), 1u);
    EXPECT_EQ(read(gltf, {.scene = "hall"}).instances.size(), 1u);
    for (const char* name : {"0", "1"}) {  // a name comes before an index
        const Scene scene = read(gltf, {.scene = name});
        EXPECT_EQ(scene.instances.size(), 0u) << name;
        EXPECT_EQ(scene.environment.radiance, glm::vec3(1, 2, 3)) << name;
        EXPECT_EQ(part(scene, "other scenes").elements,
                  std::vector<std::string>{"scene 0 \"hall\""});
    }
    EXPECT_EQ(gltf.error({.scene = "attic"}),
              "scene.glb: has no scene \"attic\"; it has 0 \"hall\", 1 \"0\"");
    EXPECT_EQ(gltf.error({.scene = "2"}),
              "scene.glb: has no scene \"2\"; it has 0 \"hall\", 1 \"0\"");
}

TEST(SceneParts, ExtensionsWithAFactorOf0HaveNoEffect) {
    GltfBuilder gltf = plain_scene();
    gltf.json["materials"][0]["extensions"] = {
        {"KHR_materials_volume", {{"attenuationDistance", 1}}},
        {"KHR_materials_transmission", {{"transmissionFactor", 0}}}};
    const Scene scene = read(gltf);
    EXPECT_TRUE(warnings(scene).empty());
    for (const char* name : {"KHR_materials_volume", "KHR_materials_transmission"})
        EXPECT_EQ(part(scene, name).use, PartUse::Read) << name;
}

TEST(SceneParts, LightsThatNoNodeHasAreNotRead) {
    GltfBuilder gltf = plain_scene();
    gltf.json["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf.json["nodes"][1].erase("extensions");
    const Scene scene = read(gltf);
    EXPECT_EQ(part(scene, "KHR_lights_punctual").use, PartUse::Ignored);
    EXPECT_EQ(part(scene, "KHR_lights_punctual").note, "no node has one of its lights");
}

TEST(SceneParts, MetalsLetNoLightThrough) {
    const auto note_of = [](const Json& material) {
        GltfBuilder gltf = plain_scene();
        gltf.json["materials"][0].update(material);
        gltf.json["materials"][0]["extensions"]["KHR_materials_transmission"] = {
            {"transmissionFactor", 1}};
        return part(read(gltf), "KHR_materials_transmission").note;
    };
    const char* kOpaque = "metals let no light through: metallicFactor is 1";
    EXPECT_EQ(note_of(Json::object()), kOpaque);  // the default of glTF
    EXPECT_EQ(note_of({{"pbrMetallicRoughness", {{"metallicFactor", 1}}}}), kOpaque);
    EXPECT_EQ(note_of({{"pbrMetallicRoughness", {{"metallicFactor", 0.5}}}}),
              "light shines straight through, as through holes");
    EXPECT_EQ(note_of({{"extensions", {{"KHR_materials_unlit", Json::object()}}}}),
              "unlit materials let no light through");
}

TEST(SceneParts, RowsOfManyKindsAreFew) {
    GltfBuilder gltf = plain_scene();
    for (int i = 0; i < 3000; ++i) gltf.json["extensionsUsed"].push_back(str_cat("EXT_", i));
    const Scene scene = read(gltf);
    EXPECT_LE(scene.parts.size(), 1100u);
    EXPECT_GT(part(scene, "other parts").count, 1900u);
    EXPECT_LE(scene.warnings.size(), 1100u);
}

TEST(SceneParts, RemembersWhatWasAskedFor) {
    GltfBuilder gltf = plain_scene();
    EXPECT_EQ(read(gltf).choice, SceneChoice());
    const SceneChoice choice = read(gltf, {.scene = "0", .light_unit = LightUnit::Watt}).choice;
    EXPECT_EQ(choice, (SceneChoice{"0", std::nullopt, "", true}));
}

TEST(SceneParts, ScenesOfOneNameAreToldApartByTheirIndices) {
    GltfBuilder gltf = plain_scene();
    gltf.json["scenes"][0]["name"] = "day";
    gltf.json["scenes"][1] = {{"name", "day"}, {"nodes", {1}}};
    EXPECT_EQ(gltf.error({.scene = "day"}),
              "scene.glb: has 2 scenes \"day\", which a number tells apart: it has 0 \"day\", 1 "
              "\"day\"");
    EXPECT_EQ(read(gltf, {.scene = "1"}).instances.size(), 0u);
}

TEST(SceneParts, ExtrasThatOtherProgramsMayHaveAreNoMistakes) {
    GltfBuilder gltf = plain_scene();
    gltf.json["nodes"][0]["extras"] = {{"weight", 80}, {"model", "x"}, {"angles", {1, 2}},
                                       {"shapes", 3},  {"mode", 1},    {"sky", 0.5}};
    const Scene scene = read(gltf);
    EXPECT_EQ(warnings(scene), std::vector<std::string>{});
    EXPECT_EQ(part(scene, "other extras").count, 6u);
}

TEST(SceneParts, AnImageBasedLightThatTheSceneDoesNotNameIsNoSky) {
    GltfBuilder gltf = plain_scene();
    gltf.json["extensionsUsed"] = {"EXT_lights_image_based"};
    gltf.json["extensions"]["EXT_lights_image_based"] = {
        {"lights", {{{"specularImages", Json::array()}, {"specularImageSize", 4}}}}};
    EXPECT_EQ(warnings(read(gltf)),
              std::vector<std::string>{
                  "EXT_lights_image_based (the file): the scene names none of its lights"});
}

TEST(SceneParts, ControlCharactersOfNamesAreBlanks) {
    GltfBuilder gltf = plain_scene();
    gltf.json["nodes"][1]["name"] = "tab\tnew\nline.001";
    gltf.json["nodes"][0]["name"] = "\x7f";
    const Scene scene = read(gltf);
    EXPECT_EQ(scene.light_names, std::vector<std::string>{"tab new line.001"});
    EXPECT_EQ(scene.instances.at(0).name, " ");
    EXPECT_EQ(warnings(scene), std::vector<std::string>{
                                   "names (node 0 \" \" and 1 more): have blanks "
                                   "here in place of line breaks and other control characters"});
}

TEST(SceneParts, LumensOfWattsBecomeWatts) {
    GltfBuilder gltf = plain_scene();
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 683.0 * 4.0;
    EXPECT_FLOAT_EQ(read(gltf).lights.at(0).intensity.x, 2732.0f);
    EXPECT_FLOAT_EQ(read(gltf, {.light_unit = LightUnit::Watt}).lights.at(0).intensity.x, 4.0f);
}

/// Adds a sun and emission of 1.
GltfBuilder with_sun(double lux) {
    GltfBuilder gltf = plain_scene();
    gltf.json["materials"][0]["emissiveFactor"] = {1, 0.5, 0};
    const size_t light =
        gltf.add_light({{"name", "sun"}, {"type", "directional"}, {"intensity", lux}});
    gltf.add_root({{"name", "sun"}, {"extensions", GltfBuilder::light_extension(light)}});
    return gltf;
}

TEST(SceneParts, LumensOfWattsBesideEmissionAreNoticed) {
    const GltfBuilder gltf = with_sun(3.0 * 683.0);
    EXPECT_EQ(warnings(read(gltf)),
              std::vector<std::string>{
                  "units of lights (\"sun\"): the sun is 2049 lux beside emission of 1, as "
                  "exporters write it that count a watt as 683 lumens; --light-unit watt divides "
                  "lights by 683"});
    EXPECT_TRUE(warnings(read(gltf, {.light_unit = LightUnit::Watt})).empty());
    EXPECT_TRUE(warnings(read(with_sun(3.0))).empty());
    GltfBuilder bright = gltf;  // a scene in lux and nits
    bright.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {
        {"emissiveStrength", 5000}};
    EXPECT_TRUE(warnings(read(bright)).empty());
}

/// A lamp of watts as an exporter writes it that counts a watt as 683 lumens.
double standard_candela(double watts) {
    return static_cast<float>(watts) * 683.0 / (4.0 * std::numbers::pi);
}

/// Lights of these types and intensities, and emission of 1.
GltfBuilder with_lights(const std::vector<std::pair<std::string, double>>& lights) {
    GltfBuilder gltf = plain_scene();
    gltf.json["materials"][0]["emissiveFactor"] = {1, 0.5, 0};
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 0;
    for (const auto& [type, intensity] : lights) {
        const size_t light = gltf.add_light({{"type", type}, {"intensity", intensity}});
        gltf.add_root({{"name", type}, {"extensions", GltfBuilder::light_extension(light)}});
    }
    return gltf;
}

TEST(SceneParts, LumensOfWattsOfLampsAreKnownByTheirDigits) {
    for (const char* type : {"point", "spot"}) {
        for (const double watts : {1000.0, 0.1, 37.7, 1e-4, 1e7, 123456.789}) {
            const auto found = warnings(read(with_lights({{type, standard_candela(watts)}})));
            ASSERT_EQ(found.size(), 1u) << type << watts;
            EXPECT_TRUE(
                found[0].starts_with(str_cat("units of lights (\"", type, "\"): the light")))
                << found[0];
            EXPECT_TRUE(found[0].ends_with("--light-unit watt divides lights by 683")) << found[0];
            const double unitless = standard_candela(watts) / 683.0;
            EXPECT_TRUE(warnings(read(with_lights({{type, unitless}}))).empty()) << watts;
            EXPECT_TRUE(warnings(read(with_lights({{type, watts}}))).empty()) << watts;
        }
    }
    EXPECT_EQ(
        warnings(read(with_lights({{"point", standard_candela(1000.0)}}))).at(0),
        "units of lights (\"point\"): the light is 54351.414 candela beside emission of 1, as "
        "exporters write it that count a watt as 683 lumens; --light-unit watt divides lights by "
        "683");
}

TEST(SceneParts, OneLightInAnotherUnitIsEvidenceAgainstLumensOfWatts) {
    const double lamp = standard_candela(1000.0);
    EXPECT_EQ(warnings(read(with_lights({{"point", lamp}, {"spot", lamp / 7.0}}))).size(), 0u);
    EXPECT_EQ(warnings(read(with_lights({{"point", lamp}, {"directional", 3 * 683.0}}))).size(),
              1u);
    EXPECT_EQ(warnings(read(with_lights({{"point", lamp}, {"directional", 100000.0}}))).size(), 0u);
}

TEST(SceneParts, SunsOfLumensOfWattsAreKnownInFilesOfBlender) {
    GltfBuilder gltf = with_lights({{"directional", static_cast<float>(0.2) * 683.0}});
    EXPECT_EQ(warnings(read(gltf)).size(), 0u);
    gltf.json["asset"]["generator"] = "Khronos glTF Blender I/O v3.4.50";
    EXPECT_EQ(warnings(read(gltf)).size(), 1u);
    gltf = with_lights({{"directional", static_cast<float>(0.05) * 683.0}});
    gltf.json["asset"]["generator"] = "Khronos glTF Blender I/O v3.4.50";
    EXPECT_EQ(warnings(read(gltf)).size(), 0u);
}

TEST(SceneParts, DaylightBesideEmissionIsNoMistake) {
    EXPECT_EQ(warnings(read(with_sun(100000.0))).size(), 0u);
    EXPECT_EQ(warnings(read(with_sun(6000.0))).size(), 1u);
}

TEST(SceneParts, LumensOfWattsMatterBesideEmissionOrASky) {
    GltfBuilder gltf = with_lights({{"point", standard_candela(1000.0)}});
    gltf.json["materials"][0].erase("emissiveFactor");
    const Scene alone = read(gltf);
    EXPECT_EQ(warnings(alone).size(), 0u);
    EXPECT_EQ(part(alone, "units of lights").note,
              "the light is 54351.414 candela, as exporters write it that count a watt as 683 "
              "lumens");
    const auto beside_sky = warnings(read(gltf, {.has_other_sky = true}));
    ASSERT_EQ(beside_sky.size(), 1u);
    EXPECT_NE(beside_sky[0].find("beside a sky,"), std::string::npos) << beside_sky[0];
    gltf.json["scenes"][0]["extras"]["sky"] = {{"radiance", {0.1, 0.2, 0.05}}};
    const auto beside_own_sky = warnings(read(gltf));
    ASSERT_EQ(beside_own_sky.size(), 1u);
    EXPECT_NE(beside_own_sky[0].find("beside emission of 0.2,"), std::string::npos);
}

TEST(SceneParts, CentimetresAreNoticed) {
    const auto doors = [](double scale, const char* light_type) {
        GltfBuilder gltf;
        const size_t mesh = gltf.add_mesh({0, 0, 0, 90, 0, 0, 90, 200, 0});
        for (int i = 0; i < 4; ++i) {
            gltf.add_root({{"mesh", mesh}, {"scale", {scale, scale, scale}}});
        }
        const size_t light = gltf.add_light({{"type", light_type}});
        gltf.add_root({{"extensions", GltfBuilder::light_extension(light)}});
        return gltf;
    };
    EXPECT_EQ(warnings(read(doors(1.0, "point"))),
              std::vector<std::string>{
                  "units of length (the scene): the boxes of three of four objects have diagonals "
                  "of more than 219 m; metres are assumed; if the unit is a centimetre, scale the "
                  "scene by 0.01"});
    EXPECT_TRUE(warnings(read(doors(0.01, "point"))).empty());
    // The light of a sun is the same in every unit.
    const Scene sunny = read(doors(1.0, "directional"));
    EXPECT_TRUE(warnings(sunny).empty());
    EXPECT_EQ(part(sunny, "units of length").count, 1u);
}

/// A room of 9 x 9 x 3 m in centimetres, and its door, with a lamp at a height.
GltfBuilder room(double scale, double lamp_height) {
    GltfBuilder gltf;
    const size_t floor = gltf.add_mesh({-450, 0, -450, 450, 0, -450, 0, 0, 450});
    const size_t door = gltf.add_mesh({-450, 0, 0, -450, 0, 90, -450, 200, 90});
    const Json scales = {scale, scale, scale};
    gltf.add_root({{"mesh", floor}, {"scale", scales}});
    gltf.add_root({{"mesh", door}, {"scale", scales}});
    const size_t light = gltf.add_light({{"type", "point"}});
    gltf.add_root({{"name", "lamp"},
                   {"translation", {0, lamp_height, 0}},
                   {"extensions", GltfBuilder::light_extension(light)}});
    return gltf;
}

TEST(SceneParts, CentimetresOfTwoObjectsAreNoticedByTheirLamps) {
    EXPECT_EQ(
        warnings(read(room(1.0, 200.0))),
        std::vector<std::string>{
            "units of length (the scene): the boxes of all objects have diagonals of more than "
            "219 m, and all lamps are farther than 20 m from them; metres are assumed; if the unit "
            "is a centimetre, scale the scene by 0.01"});
    EXPECT_TRUE(warnings(read(room(0.01, 2.0))).empty());
    EXPECT_TRUE(warnings(read(room(1.0, 5.0))).empty());  // a street lamp in a landscape
    GltfBuilder dark = room(1.0, 200.0);
    dark.json["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "directional";
    EXPECT_TRUE(warnings(read(dark)).empty());
    EXPECT_EQ(length_unit_hint(read(room(1.0, 2.0))),
              "the scene is 900 m wide; if its unit is a centimetre, scale it by 0.01");
    EXPECT_EQ(length_unit_hint(read(room(0.5, 2.0))), "");
    EXPECT_EQ(length_unit_hint(Scene{}), "");
}

}  // namespace
}  // namespace tetralight
