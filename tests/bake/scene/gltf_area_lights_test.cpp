// SPDX-License-Identifier: Apache-2.0
// EXT_lights_area, which bake/scene/detail/gltf_lights.cpp reads.
#include <tetralight/bake/scene/detail/gltf_lights.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

constexpr float kPi = std::numbers::pi_v<float>;
const char* const kExtension = "EXT_lights_area";

/// A scene with one area light on a node "lamp" that has these further properties.
GltfBuilder panel(Json light, Json node = Json::object()) {
    GltfBuilder gltf;
    gltf.json["extensions"][kExtension]["lights"] = Json::array({std::move(light)});
    node["name"] = "lamp";
    node["extensions"][kExtension]["light"] = 0;
    gltf.add_root(std::move(node));
    return gltf;
}

/// The one light of a scene; a default one, and a failed test, where there is none.
Light light_of(const GltfBuilder& gltf, const SceneReading& reading = {}) {
    const auto scene = gltf.read(reading);
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene || scene->lights.size() != 1) return {};
    return scene->lights[0];
}

Json rectangle(double size, double aspect) {
    return {{"type", "rect"}, {"intensity", 200}, {"size", size}, {"rect", {{"aspect", aspect}}}};
}

Json disk(double size) {
    return {{"type", "disk"}, {"intensity", 200}, {"size", size}};
}

TEST(GltfAreaLights, ARectangleIsAsWideAsItsAspectSays) {
    const Light light = light_of(panel(rectangle(2.0, 1.5)));
    EXPECT_EQ(light.type, LightType::Rectangle);
    EXPECT_EQ(light.height, 2.0f);
    EXPECT_EQ(light.width, 3.0f);
    EXPECT_EQ(light.direction, glm::vec3(0, 0, -1));
    EXPECT_EQ(light.tangent, glm::vec3(1, 0, 0));
    EXPECT_EQ(light.radius, 0.0f);
    EXPECT_EQ(light.range, 0.0f);
}

TEST(GltfAreaLights, TheSizeOfADiskIsItsDiameter) {
    const Light light = light_of(panel(disk(1.5)));
    EXPECT_EQ(light.type, LightType::Disc);
    EXPECT_EQ(light.radius, 0.75f);
}

TEST(GltfAreaLights, DefaultsAreASquareOfAMetreAndWhite) {
    const auto scene = panel({{"type", "rect"}, {"name", "panel"}}).read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    const Light& light = scene->lights.at(0);
    EXPECT_EQ(glm::vec2(light.width, light.height), glm::vec2(1.0f));
    EXPECT_EQ(light.intensity, glm::vec3(1000.0f));
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_TRUE(scene->warnings[0].ends_with(
        "scene.glb: area lights without intensity (area light 0 \"panel\"): none stands for "
        "1000 cd/m² in EXT_lights_area, and for 1 in files of Babylon.js; give them an intensity"))
        << scene->warnings[0];
}

TEST(GltfAreaLights, TheLargestScaleOfTheNodeCounts) {
    for (const Json& scale : {Json{1, 3, 2}, Json{-3, 1, 1}, Json{0.5, 0.25, -3}}) {
        const Light light = light_of(panel(rectangle(2.0, 1.5), {{"scale", scale}}));
        EXPECT_FLOAT_EQ(light.height, 6.0f) << scale;
        EXPECT_FLOAT_EQ(light.width, 9.0f) << scale;
        EXPECT_FLOAT_EQ(light_of(panel(disk(1.5), {{"scale", scale}})).radius, 2.25f) << scale;
    }
}

TEST(GltfAreaLights, TheNodePlacesAndTurnsTheLight) {
    // A quarter turn about +Y takes -Z to -X and +X to -Z.
    const double half = std::sqrt(0.5);
    const Light light = light_of(
        panel(rectangle(1.0, 2.0), {{"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}}));
    EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    EXPECT_NEAR(light.direction.x, -1.0f, 1e-6f);
    EXPECT_NEAR(light.tangent.z, -1.0f, 1e-6f);
}

TEST(GltfAreaLights, FluxIsLuminanceTimesAreaTimesPi) {
    // A Lambert surface of intensity I along its normal emits pi I: 200 * (3 * 4.5) * pi.
    const Json size = {{"scale", {1.5, 1, 1}}};
    EXPECT_NEAR(kPi * light_of(panel(rectangle(2.0, 1.5), size)).intensity.x, 200.0f * 13.5f * kPi,
                0.01f);
    EXPECT_NEAR(kPi * light_of(panel(disk(2.0), size)).intensity.x,
                200.0f * (kPi * 1.5f * 1.5f) * kPi, 0.01f);
}

TEST(GltfAreaLights, IrradianceOnTheAxisOfADisk) {
    // E = pi L r^2 / (r^2 + d^2), Howell's factor of a disc and a small surface that faces it.
    Json light = disk(2.0);
    light["color"] = {1.0, 0.5, 0.0};
    for (const float d : {0.1f, 1.0f, 7.0f}) {
        const glm::vec3 e =
            illuminate(light_of(panel(light, {{"translation", {0, 5, 0}}})), {0, 5, -d}).irradiance;
        const float expected = kPi * 200.0f / (1.0f + d * d);
        EXPECT_NEAR(e.x, expected, 1e-4f * expected) << d;
        EXPECT_NEAR(e.y, 0.5f * expected, 1e-4f * expected) << d;
        EXPECT_EQ(e.z, 0.0f);
    }
}

TEST(GltfAreaLights, IrradianceFarFromARectangle) {
    // L A cos / d^2, at 60 degrees to its normal; nothing behind it.
    const Light light = light_of(panel(rectangle(2.0, 1.5)));
    const float d = 1000.0f;
    const glm::vec3 there = d * glm::vec3(std::sqrt(0.75f), 0.0f, -0.5f);
    const float expected = 200.0f * 6.0f * 0.5f / (d * d);
    EXPECT_NEAR(illuminate(light, there).irradiance.x, expected, 1e-4f * expected);
    EXPECT_EQ(illuminate(light, {0, 0, 1}).irradiance.x, 0.0f);
}

TEST(GltfAreaLights, ModeAndIndirectMultiplierAreExtras) {
    Json light = disk(1.0);
    light["extras"] = {{"mode", "baked"}, {"indirect_multiplier", 2}};
    EXPECT_EQ(light_of(panel(light)).mode, LightMode::Baked);
    const Light of_node = light_of(panel(light, {{"extras", {{"mode", "realtime"}}}}));
    EXPECT_EQ(of_node.mode, LightMode::Realtime);
    EXPECT_EQ(of_node.indirect_multiplier, 2.0f);
}

TEST(GltfAreaLights, LumensOfWattsBecomeWatts) {
    Json light = rectangle(1.0, 1.0);
    light["intensity"] = 683 * 4;
    EXPECT_FLOAT_EQ(light_of(panel(light), {.light_unit = LightUnit::Watt}).intensity.x, 4.0f);
}

TEST(GltfAreaLights, ANodeMayHaveALightOfEachKind) {
    GltfBuilder gltf = panel(disk(1.0));
    const size_t bulb = gltf.add_light({{"type", "point"}});
    gltf.json["nodes"][0]["extensions"].update(GltfBuilder::light_extension(bulb));
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->lights.size(), 2u);
    EXPECT_EQ(scene->lights[0].type, LightType::Point);
    EXPECT_EQ(scene->lights[1].type, LightType::Disc);
    EXPECT_EQ(scene->light_names, (std::vector<std::string>{"lamp", "lamp"}));
}

TEST(GltfAreaLights, HiddenNodesHaveNone) {
    GltfBuilder gltf = panel(disk(1.0));
    gltf.json["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->lights.empty());
}

TEST(GltfAreaLights, AreToldAsRead) {
    const auto scene = panel(disk(1.0)).read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->warnings.empty());
    for (const char* name : {kExtension, "disc lights"}) {
        const auto row = std::ranges::find(scene->parts, name, &ScenePart::name);
        ASSERT_NE(row, scene->parts.end()) << name;
        EXPECT_EQ(row->use, PartUse::Read);
        EXPECT_EQ(row->count, 1u);
    }
}

TEST(GltfAreaLights, AFileMayRequireThem) {
    GltfBuilder gltf = panel(disk(1.0));
    gltf.json["extensionsRequired"] = {kExtension};
    EXPECT_EQ(light_of(gltf).type, LightType::Disc);
}

TEST(GltfAreaLights, UnknownTypesAreLeftOutWithAWarning) {
    const auto scene = panel({{"type", "sphere"}, {"name", "globe"}}).read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->lights.empty());
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_TRUE(scene->warnings[0].ends_with(
        "scene.glb: lights of unknown type (area light 0 \"globe\"): type \"sphere\" is not "
        "known; left out"));
}

TEST(GltfAreaLights, ThoseScaledToNothingAreLeftOutWithAWarning) {
    for (const Json& scale : {Json{0, 0, 0}, Json{1, 1, 0}}) {
        const auto scene = panel(disk(1.0), {{"scale", scale}}).read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        EXPECT_TRUE(scene->lights.empty());
        ASSERT_EQ(scene->warnings.size(), 1u);
        EXPECT_TRUE(scene->warnings[0].ends_with(
            "scene.glb: lights scaled to 0 (node 0 \"lamp\"): have no direction; left out"));
    }
}

struct Rejection {
    const char* label;
    Json light;
    Json node;
    const char* error;
    const char* field;
};

void PrintTo(const Rejection& rejection, std::ostream* stream) {
    *stream << rejection.label;
}

class GltfAreaLightsReject : public testing::TestWithParam<Rejection> {};

TEST_P(GltfAreaLightsReject, WithPlaceValueAndField) {
    const GltfBuilder gltf = panel(GetParam().light, GetParam().node);
    EXPECT_EQ(gltf.error(),
              std::string("scene.glb: node 0 \"lamp\": area light 0: ") + GetParam().error);
    const auto scene = gltf.read();
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().field, GetParam().field);
}

const Json kPlain = Json::object();

/// A disk with another member.
Json disk_with(const char* member, Json value) {
    Json light = disk(1.0);
    light[member] = std::move(value);
    return light;
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfAreaLightsReject,
    testing::Values(
        Rejection{"Intensity", disk_with("intensity", -1), kPlain, "intensity -1 is negative",
                  "extensions.EXT_lights_area.lights[0].intensity"},
        Rejection{"HugeIntensity", disk_with("intensity", 1e300), kPlain,
                  "intensity is not finite (1 * 1e+300)",
                  "extensions.EXT_lights_area.lights[0].intensity"},
        Rejection{"Color", disk_with("color", {1, -2, 1}), kPlain, "color -2 is negative",
                  "extensions.EXT_lights_area.lights[0].color[1]"},
        Rejection{"Size", disk(0.0), kPlain, "size 0 makes a light of 0 m",
                  "extensions.EXT_lights_area.lights[0].size"},
        Rejection{"Aspect", rectangle(1.0, -2.0), kPlain, "rect.aspect -2 makes a light of -2 m",
                  "extensions.EXT_lights_area.lights[0].rect.aspect"},
        Rejection{"Mode",
                  disk(1.0),
                  {{"extras", {{"mode", "off"}}}},
                  "extras.mode \"off\" is not \"mixed\", \"baked\" or \"realtime\"",
                  "nodes[0].extras.mode"},
        Rejection{"Radius", disk_with("extras", {{"radius", 2}}), kPlain,
                  "extras.radius is not for lights of EXT_lights_area, which say it themselves",
                  "extensions.EXT_lights_area.lights[0].extras.radius"},
        Rejection{"Shape",
                  disk(1.0),
                  {{"extras", {{"shape", "disc"}}}},
                  "extras.shape is not for lights of EXT_lights_area, which say it themselves",
                  "nodes[0].extras.shape"}),
    [](const auto& instance) { return std::string(instance.param.label); });

}  // namespace
}  // namespace tetralight
