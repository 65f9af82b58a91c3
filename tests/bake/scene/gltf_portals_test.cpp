// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_portals.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

GltfBuilder with_portal(Json portal, Json node = Json::object()) {
    GltfBuilder gltf;
    node["name"] = "window";
    node["extras"]["portal"] = std::move(portal);
    gltf.add_root(std::move(node));
    return gltf;
}

/// The one portal of a scene; a default one, and a failed test, where there is none.
Portal portal_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene || scene->portals.size() != 1) {
        ADD_FAILURE();
        return {};
    }
    return scene->portals[0];
}

TEST(GltfPortals, LieInTheXyPlaneOfTheirNode) {
    const Portal portal = portal_of(with_portal({2, 1.5}, {{"translation", {1, 2, 3}}}));
    EXPECT_EQ(portal.name, "window");
    EXPECT_EQ(portal.center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(portal.along, glm::dvec3(2, 0, 0));
    EXPECT_EQ(portal.across, glm::dvec3(0, 1.5, 0));
}

TEST(GltfPortals, TurnAndScaleWithTheirNode) {
    // A quarter turn about Y takes X to −Z.
    const Portal portal = portal_of(with_portal(
        {2, 1},
        {{"rotation", {0, 0.70710678118654757, 0, 0.70710678118654757}}, {"scale", {2, 3, 9}}}));
    EXPECT_LT(glm::distance(portal.along, glm::dvec3(0, 0, -4)), 1e-6);
    EXPECT_LT(glm::distance(portal.across, glm::dvec3(0, 3, 0)), 1e-6);
}

TEST(GltfPortals, ShearedNodesMakeRectanglesOfTheSameArea) {
    // X stays, Y goes to (1, 1, 0).
    const Portal portal = portal_of(
        with_portal({2, 1}, {{"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}));
    EXPECT_EQ(portal.along, glm::dvec3(2, 0, 0));
    EXPECT_EQ(portal.across, glm::dvec3(0, 1, 0));
}

TEST(GltfPortals, AreNoSurfaces) {
    const auto scene = with_portal({1, 1}).read();
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->instances.empty());
    EXPECT_TRUE(scene->warnings.empty());
}

TEST(GltfPortals, ErrorsNameTheNodeAndTheValue) {
    const std::string start = "scene.glb: node 0 \"window\": ";
    const std::string not_a_size = " is not a width and a height above 0";
    EXPECT_EQ(with_portal({0, 1}).error(), start + "extras.portal [0, 1]" + not_a_size);
    EXPECT_EQ(with_portal({1, -2}).error(), start + "extras.portal [1, -2]" + not_a_size);
    EXPECT_EQ(with_portal({1, 2}, {{"scale", {1, 0, 1}}}).error(),
              start + "extras.portal [1, 2] has no area: see the scale of the node");
    const std::string too_far = " reaches farther than 1e+12 m from the origin";
    EXPECT_EQ(with_portal({1e20, 1}).error(), start + "extras.portal [1e+20, 1]" + too_far);
    EXPECT_EQ(with_portal({1, 1}, {{"translation", {0, 1e13, 0}}}).error(),
              start + "extras.portal [1, 1]" + too_far);
    for (const Json& wrong : {Json("wide"), Json(1), Json({1}), Json({1, 2, 3}), Json({1, "2"})}) {
        const std::string error = with_portal(wrong).error();
        EXPECT_NE(error.find("portal"), std::string::npos) << error;
        EXPECT_NE(error.find("node"), std::string::npos) << error;
    }
}

}  // namespace
}  // namespace tetralight
