// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_cameras.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/base/str_cat.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

std::vector<Camera> cameras_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    return scene ? scene->cameras : std::vector<Camera>();
}

Json perspective(double fov_y_radians) {
    return {{"name", "lens"},
            {"type", "perspective"},
            {"perspective", {{"yfov", fov_y_radians}, {"znear", 0.1}}}};
}

TEST(GltfCameras, StandWhereTheirNodeStands) {
    GltfBuilder gltf;
    const double half = std::sqrt(0.5);
    const size_t child = gltf.add("nodes", {{"name", "eye"},
                                            {"camera", gltf.add("cameras", perspective(0.5))},
                                            {"rotation", {0, half, 0, half}}});  // −Z to −X
    gltf.add_root({{"translation", {1, 2, 3}}, {"children", {child}}});
    const auto cameras = cameras_of(gltf);
    ASSERT_EQ(cameras.size(), 1u);
    EXPECT_EQ(cameras[0].fov_y_radians, 0.5);
    EXPECT_EQ(glm::dvec3(cameras[0].world_from_camera[3]), glm::dvec3(1, 2, 3));
    EXPECT_NEAR(cameras[0].world_from_camera[2].x, 1.0, 1e-12);  // it looks along −Z
}

TEST(GltfCameras, AreNamedAfterTheirNodeOrElseByTheirOwnName) {
    GltfBuilder gltf;
    const size_t camera = gltf.add("cameras", perspective(0.5));
    gltf.add_root({{"name", "eye"}, {"camera", camera}});
    gltf.add_root({{"camera", camera}});
    const auto cameras = cameras_of(gltf);
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].name, "eye");
    EXPECT_EQ(cameras[1].name, "lens");
}

TEST(GltfCameras, AreLeftOutWhereTheScaleIs0) {
    GltfBuilder gltf;
    gltf.add_root(
        {{"name", "eye"}, {"camera", gltf.add("cameras", perspective(0.5))}, {"scale", {0, 0, 0}}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->cameras.empty());
    const auto part = std::ranges::find(scene->parts, "cameras scaled to 0", &ScenePart::name);
    ASSERT_NE(part, scene->parts.end());
    EXPECT_EQ(part->use, PartUse::Ignored);
    EXPECT_EQ(part->elements, std::vector<std::string>{"node 0 \"eye\""});
    EXPECT_FALSE(part->changes_light);
}

TEST(GltfCameras, AreLeftOutWithoutAFieldOfView) {
    for (const double fov_y : {0.0, -1.0, 5.0}) {
        GltfBuilder gltf;
        gltf.add_root({{"camera", gltf.add("cameras", perspective(fov_y))}});
        const auto scene = gltf.read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        EXPECT_TRUE(scene->cameras.empty());
        const auto part = std::ranges::find(scene->parts, PartUse::Ignored, &ScenePart::use);
        ASSERT_NE(part, scene->parts.end());
        EXPECT_EQ(part->note, str_cat("yfov ", fov_y, " is not between 0 and π radians"));
        EXPECT_EQ(part->elements, std::vector<std::string>{"camera 0 \"lens\""});
    }
}

TEST(GltfCameras, LoseTheScaleOfTheirNode) {
    GltfBuilder gltf;
    gltf.add_root({{"camera", gltf.add("cameras", perspective(0.5))}, {"scale", {2, 3, 4}}});
    const auto cameras = cameras_of(gltf);
    ASSERT_EQ(cameras.size(), 1u);
    EXPECT_EQ(cameras[0].world_from_camera, glm::dmat4(1.0));
}

Json orthographic(double half_height) {
    return {
        {"name", "plan"},
        {"type", "orthographic"},
        {"orthographic", {{"xmag", 9.0}, {"ymag", half_height}, {"znear", 0.1}, {"zfar", 10.0}}}};
}

TEST(GltfCameras, OrthographicOnesHaveAHeightThatTheirNodeDoesNotScale) {
    GltfBuilder gltf;
    gltf.add_root({{"camera", gltf.add("cameras", perspective(0.5))}});
    gltf.add_root({{"camera", gltf.add("cameras", orthographic(2.5))}, {"scale", {2, 3, 4}}});
    const auto cameras = cameras_of(gltf);
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].half_height, std::nullopt);
    EXPECT_EQ(cameras[1].half_height, 2.5);
    EXPECT_EQ(cameras[1].name, "plan");
    EXPECT_EQ(cameras[1].world_from_camera, glm::dmat4(1.0));
}

TEST(GltfCameras, AreIgnoredIfTheyShowNothing) {
    GltfBuilder gltf;
    for (const Json& camera :
         {orthographic(0.0), orthographic(-1.0), orthographic(1.0), Json{{"type", "fisheye"}}}) {
        gltf.add_root({{"camera", gltf.add("cameras", camera)}});
    }
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->cameras.size(), 1u);
    EXPECT_EQ(scene->cameras[0].half_height, 1.0);
    std::vector<std::string> notes;
    for (const ScenePart& part : scene->parts) {
        if (part.name == "cameras" && part.use == PartUse::Ignored) notes.push_back(part.note);
    }
    EXPECT_EQ(notes, (std::vector<std::string>{
                         "ymag 0 is not above 0", "ymag -1 is not above 0",
                         "type \"fisheye\" is neither perspective nor orthographic"}));
}

/// A document whose default scene has this sky.
GltfBuilder with_sky(const Json& radiance) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    gltf.json["scenes"][0]["extras"] = {{"sky", {{"radiance", radiance}}}};
    return gltf;
}

TEST(GltfSky, IsTheEnvironmentsRadiance) {
    const auto scene = with_sky({0.5, 1, 2}).read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->environment, (Environment{{0.5f, 1.0f, 2.0f}, {}, 0.0f}));
}

TEST(GltfSky, MayBeWhatDialogsForPropertiesOffer) {
    const std::pair<Json, glm::vec3> skies[] = {
        {{0.5, 1, 2}, {0.5f, 1.0f, 2.0f}},
        {0.25, glm::vec3(0.25f)},
        {0, glm::vec3(0.0f)},
        {"0.25", glm::vec3(0.25f)},
        {"[0.5, 1, 2]", {0.5f, 1.0f, 2.0f}},
        {"{\"radiance\": [0.5, 1, 2]}", {0.5f, 1.0f, 2.0f}}};
    GltfBuilder gltf = with_sky({});
    for (const auto& [sky, radiance] : skies) {
        gltf.json["scenes"][0]["extras"]["sky"] = sky;
        const auto scene = gltf.read();
        ASSERT_TRUE(scene) << error_text(scene.error());
        EXPECT_EQ(scene->environment, (Environment{radiance, {}, 0.0f})) << sky;
        EXPECT_TRUE(scene->warnings.empty()) << sky;
    }
}

TEST(GltfSky, IsBlackWhenTheFileDoesNotSay) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->environment, Environment{});
}

TEST(GltfSky, RejectsNegativeRadiance) {
    EXPECT_EQ(with_sky({0.5, -1, 2}).error(),
              "scene.glb: scene: extras.sky.radiance (0.5, -1, 2) is negative");
}

TEST(GltfSky, RejectsWhatIsNotThreeNumbers) {
    EXPECT_NE(with_sky({1, 2}).error().find("sky"), std::string::npos);
    EXPECT_NE(with_sky("blue").error().find("sky"), std::string::npos);
}

TEST(GltfSky, NamesASkyThatIsNone) {
    GltfBuilder gltf;
    const Json skies[] = {true,
                          nullptr,
                          Json::array(),
                          {1, 2},
                          {1, 2, 3, 4},
                          {1, "2", 3},
                          "blue",
                          "",
                          "[1, 2",
                          "\"[1, 2, 3]\"",
                          std::string(100, '['),
                          Json::object(),
                          {{"radiance", {1, 2}}},
                          {{"radience", {1, 1, 1}}}};
    for (const Json& sky : skies) {
        gltf.json["scenes"][0]["extras"]["sky"] = sky;
        const std::string error = gltf.error();
        EXPECT_TRUE(error.starts_with("scene.glb: scene 0: extras.sky is ")) << error;
        EXPECT_TRUE(error.ends_with("; write {\"radiance\": [r, g, b]}")) << error;
    }
    const auto scene = gltf.read();
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().field, "scenes[0].extras.sky");
    gltf.json["scenes"][0]["extras"]["sky"] = -1;
    EXPECT_EQ(gltf.error(), "scene.glb: scene: extras.sky.radiance (-1, -1, -1) is negative");
}

}  // namespace
}  // namespace tetralight
