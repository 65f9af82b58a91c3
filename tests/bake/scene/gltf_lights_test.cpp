// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_lights.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// A scene with one light on a node "lamp" that has these further properties.
GltfBuilder lamp(Json light, Json node = Json::object()) {
    GltfBuilder gltf;
    node["name"] = "lamp";
    node["extensions"] = GltfBuilder::light_extension(gltf.add_light(std::move(light)));
    gltf.add_root(std::move(node));
    return gltf;
}

/// The one light of a scene; a default one, and a failed test, where there is none.
Light light_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene || scene->lights.size() != 1) return {};
    return scene->lights[0];
}

TEST(GltfLights, DirectionalLightIsColorTimesLux) {
    const Light light =
        light_of(lamp({{"type", "directional"}, {"color", {1.0, 0.5, 0.25}}, {"intensity", 1000}}));
    EXPECT_EQ(light.type, LightType::Directional);
    EXPECT_EQ(light.intensity, glm::vec3(1000, 500, 250));
    EXPECT_EQ(light.direction, glm::vec3(0, 0, -1));
}

TEST(GltfLights, DefaultsAreWhiteAndOne) {
    const Light light = light_of(lamp({{"type", "point"}}));
    EXPECT_EQ(light.type, LightType::Point);
    EXPECT_EQ(light.intensity, glm::vec3(1.0f));
    EXPECT_EQ(light.range, 0.0f);
    EXPECT_EQ(light.mode, LightMode::Mixed);
}

TEST(GltfLights, NodePlacesAndTurnsTheLight) {
    const double half = std::sqrt(0.5);
    // -90 degrees about +X turn -Z to -Y; scale changes neither direction length nor units.
    const Light light = light_of(lamp(
        {{"type", "spot"}, {"spot", Json::object()}, {"range", 8}},
        {{"translation", {1, 2, 3}}, {"rotation", {-half, 0, 0, half}}, {"scale", {2, 2, 2}}}));
    EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    EXPECT_NEAR(light.direction.y, -1.0f, 1e-6f);
    EXPECT_NEAR(light.direction.z, 0.0f, 1e-6f);
    EXPECT_EQ(light.range, 8.0f);
}

TEST(GltfLights, SpotAnglesBecomeCosines) {
    const Light light = light_of(
        lamp({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}));
    EXPECT_EQ(light.type, LightType::Spot);
    EXPECT_FLOAT_EQ(light.cos_inner_cone, std::cos(0.25f));
    EXPECT_FLOAT_EQ(light.cos_outer_cone, std::cos(0.5f));
}

TEST(GltfLights, SpotDefaultsToZeroAndFortyFiveDegrees) {
    const Light light = light_of(lamp({{"type", "spot"}, {"spot", Json::object()}}));
    EXPECT_FLOAT_EQ(light.cos_inner_cone, 1.0f);
    EXPECT_FLOAT_EQ(light.cos_outer_cone, std::sqrt(0.5f));
}

TEST(GltfLights, HardEdgedAndHalfSphereConesAreAllowed) {
    const double right_angle = static_cast<float>(std::numbers::pi / 2);  // above pi / 2
    const Light light = light_of(
        lamp({{"type", "spot"},
              {"spot", {{"innerConeAngle", right_angle}, {"outerConeAngle", right_angle}}}}));
    EXPECT_NEAR(light.cos_outer_cone, 0.0f, 1e-7f);
    EXPECT_EQ(light.cos_inner_cone, light.cos_outer_cone);
}

TEST(GltfLights, ModeOfTheLight) {
    EXPECT_EQ(light_of(lamp({{"type", "point"}, {"extras", {{"mode", "baked"}}}})).mode,
              LightMode::Baked);
}

TEST(GltfLights, ModeOfTheNodeWins) {
    EXPECT_EQ(light_of(lamp({{"type", "point"}, {"extras", {{"mode", "baked"}}}},
                            {{"extras", {{"mode", "mixed"}}}}))
                  .mode,
              LightMode::Mixed);
}

TEST(GltfLights, RealtimeMode) {
    EXPECT_EQ(light_of(lamp({{"type", "point"}, {"extras", {{"mode", "realtime"}}}})).mode,
              LightMode::Realtime);
}

Light bulb(Json extras) {
    return light_of(lamp({{"type", "point"}, {"range", 8}, {"extras", std::move(extras)}}));
}

TEST(GltfLights, Falloffs) {
    EXPECT_EQ(bulb(Json::object()).falloff, LightFalloff::Gltf);
    EXPECT_EQ(bulb({{"falloff", "gltf"}}).falloff, LightFalloff::Gltf);
    EXPECT_EQ(bulb({{"falloff", "inverse-square-range"}}).falloff,
              LightFalloff::InverseSquareRange);
    EXPECT_EQ(bulb({{"falloff", "linear"}}).falloff, LightFalloff::Linear);
    EXPECT_EQ(bulb({{"falloff", "legacy"}}).falloff, LightFalloff::Legacy);
}

TEST(GltfLights, IndirectMultiplierAndRadius) {
    const Light light = bulb({{"indirect_multiplier", 2.5}, {"radius", 0.25}});
    EXPECT_EQ(light.indirect_multiplier, 2.5f);
    EXPECT_EQ(light.radius, 0.25f);
    EXPECT_EQ(light.type, LightType::Point);
}

TEST(GltfLights, AngleIsTheWholeDiameterInDegrees) {
    const Light sun = light_of(lamp({{"type", "directional"}, {"extras", {{"angle", 90}}}}));
    EXPECT_FLOAT_EQ(sun.radius, static_cast<float>(std::numbers::pi / 4));
}

TEST(GltfLights, EachExtraOfTheNodeWins) {
    const Light light = light_of(
        lamp({{"type", "point"}, {"range", 8}, {"extras", {{"falloff", "linear"}, {"radius", 1}}}},
             {{"extras", {{"radius", 2}, {"mode", "baked"}}}}));
    EXPECT_EQ(light.radius, 2.0f);
    EXPECT_EQ(light.falloff, LightFalloff::Linear);
    EXPECT_EQ(light.mode, LightMode::Baked);
}

TEST(GltfLights, RectangleLiesAcrossItsNode) {
    // A quarter turn about +Y takes -Z to -X and +X to -Z; sizes are metres whatever the scale.
    const double half = std::sqrt(0.5);
    const Light light =
        light_of(lamp({{"type", "spot"},
                       {"spot", Json::object()},
                       {"intensity", 5},
                       {"extras", {{"shape", "rectangle"}, {"width", 3}, {"height", 2}}}},
                      {{"rotation", {0, half, 0, half}}, {"scale", {4, 5, 6}}}));
    EXPECT_EQ(light.type, LightType::Rectangle);
    EXPECT_EQ(light.intensity, glm::vec3(5.0f));
    EXPECT_EQ(glm::vec2(light.width, light.height), glm::vec2(3, 2));
    EXPECT_NEAR(light.direction.x, -1.0f, 1e-6f);
    EXPECT_NEAR(light.tangent.z, -1.0f, 1e-6f);
}

TEST(GltfLights, TangentOfAShearedNodeIsAcrossItsDirection) {
    // X leans towards Z; the direction is -Z, so that the tangent is X alone.
    const Light light = light_of(
        lamp({{"type", "point"}, {"extras", {{"shape", "rectangle"}, {"width", 1}, {"height", 1}}}},
             {{"matrix", {1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}));
    EXPECT_EQ(light.tangent, glm::vec3(1, 0, 0));
}

TEST(GltfLights, DiscHasARadius) {
    const Light light = bulb({{"shape", "disc"}, {"radius", 0.5}});
    EXPECT_EQ(light.type, LightType::Disc);
    EXPECT_EQ(light.radius, 0.5f);
    EXPECT_EQ(light.direction, glm::vec3(0, 0, -1));
}

TEST(GltfLights, NamesAreTheNodesElseTheLights) {
    GltfBuilder gltf = lamp({{"type", "point"}, {"name", "bulb"}});
    gltf.add_root({{"extensions", GltfBuilder::light_extension(0)}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->light_names, (std::vector<std::string>{"lamp", "bulb"}));
    EXPECT_EQ(scene->lights.size(), 2u);
}

TEST(GltfLights, UnknownTypeIsLeftOutWithAWarning) {
    const auto scene = lamp({{"type", "area"}, {"name", "panel"}}).read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->lights.empty());
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_TRUE(scene->warnings[0].ends_with(
        "scene.glb: lights of unknown type (light 0 \"panel\"): type \"area\" is not known; "
        "left out"));
}

TEST(GltfLights, PointLightNeedsNoDirection) {
    EXPECT_EQ(light_of(lamp({{"type", "point"}}, {{"scale", {0, 0, 0}}})).type, LightType::Point);
}

TEST(GltfLights, AreLeftOutWhereAScaleOf0LeavesThemNoDirection) {
    const Json rectangle = {{"type", "point"},
                            {"extras", {{"shape", "rectangle"}, {"width", 1}, {"height", 1}}}};

    struct Case {
        Json light;
        Json scale;
        const char* missing;
    };

    const Case cases[] = {{{{"type", "directional"}}, {1, 1, 0}, "direction"},
                          {{{"type", "spot"}}, {0, 0, 0}, "direction"},
                          {rectangle, {0, 1, 1}, "width"}};
    for (const Case& c : cases) {
        const auto scene = lamp(c.light, {{"scale", c.scale}}).read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        EXPECT_EQ(scene->lights.size(), 0u);
        ASSERT_EQ(scene->warnings.size(), 1u);
        EXPECT_TRUE(scene->warnings[0].ends_with(str_cat(
            "scene.glb: lights scaled to 0 (node 0 \"lamp\"): have no ", c.missing, "; left out")))
            << scene->warnings[0];
    }
}

TEST(GltfLights, ShineOnNodesThatAreScaledTo0AcrossTheirDirection) {
    for (const char* type : {"point", "spot", "directional"}) {
        const double depth = type == std::string("point") ? 0.0 : 2.0;
        const auto scene = lamp({{"type", type}}, {{"scale", {0, 0, depth}}}).read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        ASSERT_EQ(scene->lights.size(), 1u) << type;
        EXPECT_TRUE(scene->warnings.empty());
        if (depth == 0.0) continue;
        EXPECT_EQ(scene->lights[0].direction, glm::vec3(0, 0, -1));
    }
}

struct LightRejection {
    const char* label;
    Json light;
    Json node;
    const char* error;
};

class GltfLightsReject : public testing::TestWithParam<LightRejection> {};

TEST_P(GltfLightsReject, WithPlaceAndValue) {
    EXPECT_EQ(lamp(GetParam().light, GetParam().node).error(),
              std::string("scene.glb: node 0 \"lamp\": light 0: ") + GetParam().error);
}

const Json kNoExtras = Json::object();

Json spot(double inner, double outer) {
    return {{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}};
}

/// Extras of the light's node that are refused.
LightRejection bad_extras(const char* label, Json extras, const char* error,
                          const char* type = "point") {
    return {label, {{"type", type}}, {{"extras", std::move(extras)}}, error};
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfLightsReject,
    testing::Values(
        LightRejection{"Intensity",
                       {{"type", "point"}, {"intensity", -1}},
                       kNoExtras,
                       "intensity -1 is negative"},
        LightRejection{"Color",
                       {{"type", "point"}, {"color", {1, -0.5, 1}}},
                       kNoExtras,
                       "color -0.5 is negative"},
        LightRejection{"Overflow",
                       {{"type", "point"}, {"intensity", 1e300}},
                       kNoExtras,
                       "intensity is not finite (1 * 1e+300)"},
        LightRejection{"Range",
                       {{"type", "point"}, {"range", -2}},
                       kNoExtras,
                       "range -2 is negative or too large"},
        LightRejection{"Inner", spot(-0.1, 0.5), kNoExtras,
                       "cone angles -0.1 and 0.5 are not 0 <= inner <= outer <= pi / 2"},
        LightRejection{"InnerAboveOuter", spot(0.6, 0.5), kNoExtras,
                       "cone angles 0.6 and 0.5 are not 0 <= inner <= outer <= pi / 2"},
        LightRejection{"Outer", spot(0.1, 2), kNoExtras,
                       "cone angles 0.1 and 2 are not 0 <= inner <= outer <= pi / 2"},
        LightRejection{"FarAway",
                       {{"type", "point"}},
                       {{"translation", {1e300, 0, 0}}},
                       "position is too far away (1e+300)"},
        LightRejection{"NodeMode",
                       {{"type", "point"}},
                       {{"extras", {{"mode", "dynamic"}}}},
                       "extras.mode \"dynamic\" is not \"mixed\", \"baked\" or \"realtime\""},
        bad_extras("Falloff", {{"falloff", "cubic"}},
                   "extras.falloff \"cubic\" is not \"gltf\", \"inverse-square-range\", "
                   "\"linear\" or \"legacy\""),
        bad_extras("LinearWithoutRange", {{"falloff", "linear"}},
                   "extras.falloff \"linear\" needs a range > 0"),
        bad_extras("LegacyWithoutRange", {{"falloff", "legacy"}},
                   "extras.falloff \"legacy\" needs a range > 0"),
        bad_extras("SquareWithoutRange", {{"falloff", "inverse-square-range"}},
                   "extras.falloff \"inverse-square-range\" needs a range > 0"),
        bad_extras("Multiplier", {{"indirect_multiplier", -1}},
                   "extras.indirect_multiplier -1 is negative or too large"),
        bad_extras("Radius", {{"radius", 1e300}}, "extras.radius 1e+300 is negative or too large"),
        bad_extras("RadiusNoNumber", {{"radius", "big"}}, "extras.radius is not a number"),
        bad_extras("AngleOfAPoint", {{"angle", 1}},
                   "extras.angle is for directional lights; others have extras.radius"),
        bad_extras("Shape", {{"shape", "cube"}},
                   "extras.shape \"cube\" is neither \"rectangle\" nor \"disc\""),
        bad_extras("RectangleWithoutHeight", {{"shape", "rectangle"}, {"width", 1}},
                   "extras.shape \"rectangle\" needs a width and a height > 0"),
        bad_extras("DiscWithoutRadius", {{"shape", "disc"}},
                   "extras.shape \"disc\" needs a radius > 0"),
        bad_extras("RadiusOfASun", {{"radius", 1}},
                   "extras.radius is not for directional lights; they have extras.angle",
                   "directional"),
        bad_extras("Angle", {{"angle", 181}}, "extras.angle 181 is more than 180 degrees",
                   "directional"),
        bad_extras("FalloffOfASun", {{"falloff", "legacy"}},
                   "extras.falloff is not for directional lights", "directional"),
        bad_extras("ShapeOfASun", {{"shape", "disc"}}, "extras.shape is not for directional lights",
                   "directional"),
        LightRejection{
            "ModeNoString",
            {{"type", "point"}},
            {{"extras", {{"mode", 3}}}},
            "extras.mode \"(not a string)\" is not \"mixed\", \"baked\" or \"realtime\""}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

}  // namespace
}  // namespace tetralight
