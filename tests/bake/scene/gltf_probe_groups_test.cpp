// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_probe_groups.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

const Json kIsGroup = {{"light_probe_group", true}};

Scene scene_of(const GltfBuilder& gltf) {
    auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    return scene ? std::move(*scene) : Scene{};
}

/// A scene with a group "hall" of two points.
GltfBuilder group_of_points(Json extras = kIsGroup) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_mesh({1, 2, 3, 4, 5, 6});
    gltf.primitive(mesh)["mode"] = 0;
    gltf.add_root({{"name", "hall"},
                   {"mesh", mesh},
                   {"translation", {10, 0, 0}},
                   {"extras", std::move(extras)}});
    return gltf;
}

const std::vector<glm::dvec3> kTwoPoints = {{1, 2, 3}, {4, 5, 6}};

TEST(GltfProbeGroups, PointsArePositionsInTheGroup) {
    const Scene scene = scene_of(group_of_points());
    ASSERT_EQ(scene.probe_groups.size(), 1u);
    const ProbeGroup& group = scene.probe_groups[0];
    EXPECT_EQ(group.name, "hall");
    EXPECT_EQ(group.positions, kTwoPoints);
    EXPECT_EQ(group.world_from_group[3], glm::dvec4(10, 0, 0, 1));
    EXPECT_FALSE(group.dering);
    EXPECT_EQ(group.rendering_layers, kAllRenderingLayers);
}

TEST(GltfProbeGroups, SayWhyTheyHaveNoProbes) {
    const auto warning = [](const GltfBuilder& gltf) {
        const Scene scene = scene_of(gltf);
        EXPECT_EQ(scene.probe_groups.size(), 1u);
        const std::string text = scene.probe_groups.at(0).empty_warning;
        return text.substr(std::min(text.find("scene.glb"), text.size()));
    };
    EXPECT_EQ(warning(group_of_points()), "");
    GltfBuilder faces = group_of_points();
    faces.primitive(0)["mode"] = 1;
    faces.json["meshes"][0]["name"] = "Grid";
    EXPECT_EQ(warning(faces),
              "scene.glb: node 0 \"hall\": the group has no probes: mesh 0 \"Grid\" has no points, "
              "but triangles or lines; delete its edges and faces, or give the node child nodes");
    faces.json["nodes"][0]["children"] = {faces.add("nodes", {{"name", "probe"}})};
    EXPECT_EQ(warning(faces), "");
    GltfBuilder nothing;
    nothing.add_root({{"name", "hall"}, {"extras", kIsGroup}});
    EXPECT_EQ(
        warning(nothing),
        "scene.glb: node 0 \"hall\": the group has no probes: it has neither a mesh of points "
        "nor child nodes (Blender: export Loose Points; light probe volumes need "
        "extras.probe_resolution)");
}

TEST(GltfProbeGroups, AScaleOf0PutsProbesIntoAPlane) {
    GltfBuilder gltf = group_of_points();
    gltf.json["nodes"][0]["scale"] = {1, 0, 1};
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.probe_groups.size(), 1u);
    EXPECT_EQ(scene.probe_groups[0].positions, kTwoPoints);
    EXPECT_EQ(scene.probe_groups[0].world_from_group[1], glm::dvec4(0.0));
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_NE(
        scene.warnings.back().find("probe groups scaled to 0 (node 0 \"hall\"): their probes"),
        std::string::npos)
        << scene.warnings.back();
}

TEST(GltfProbeGroups, AllPointPrimitivesCount) {
    GltfBuilder gltf = group_of_points();
    gltf.json["meshes"][0]["primitives"].push_back(gltf.primitive(0));
    EXPECT_EQ(scene_of(gltf).probe_groups[0].positions.size(), 4u);
}

TEST(GltfProbeGroups, IndicesChooseThePoints) {
    GltfBuilder gltf = group_of_points();
    gltf.primitive(0)["indices"] = gltf.add_accessor(std::vector<uint8_t>{1}, "SCALAR", 5121);
    EXPECT_EQ(scene_of(gltf).probe_groups[0].positions, (std::vector<glm::dvec3>{{4, 5, 6}}));
}

TEST(GltfProbeGroups, DeringIsRead) {
    const auto gltf = group_of_points({{"light_probe_group", true}, {"dering", true}});
    EXPECT_TRUE(scene_of(gltf).probe_groups[0].dering);
}

TEST(GltfProbeGroups, RenderingLayersAreRead) {
    const auto gltf = group_of_points({{"light_probe_group", true}, {"rendering_layers", {0, 3}}});
    EXPECT_EQ(scene_of(gltf).probe_groups[0].rendering_layers, 0b1001u);
}

TEST(GltfProbeGroups, RenderingLayersThatAreNoneAreRefused) {
    for (const Json& layers : {Json::array(), Json{32}, Json{-1}, Json{0.5}, Json{"a"}, Json(3)}) {
        const auto scene =
            group_of_points({{"light_probe_group", true}, {"rendering_layers", layers}}).read();
        ASSERT_FALSE(scene) << layers;
        EXPECT_EQ(scene.error().field, "nodes[0].extras.rendering_layers") << layers;
    }
}

/// A scene with a group "hall" without a mesh.
GltfBuilder box_of_probes(Json resolution) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "hall"},
                   {"translation", {10, 0, 0}},
                   {"extras", {{"light_probe_group", true}, {"probe_resolution", resolution}}}});
    return gltf;
}

TEST(GltfProbeGroups, AResolutionPutsProbesIntoTheCellsOfABox) {
    const Scene scene = scene_of(box_of_probes({2, 1, 4.0}));
    ASSERT_EQ(scene.probe_groups.size(), 1u);
    // The box is from -1 to 1: two cells of 1 m along x, one of 2 m, four of 0.5 m along z.
    std::vector<glm::dvec3> expected;
    for (const double z : {-0.75, -0.25, 0.25, 0.75})
        for (const double x : {-0.5, 0.5}) expected.emplace_back(x, 0, z);
    EXPECT_EQ(scene.probe_groups[0].positions, expected);
    EXPECT_EQ(scene.probe_groups[0].world_from_group[3], glm::dvec4(10, 0, 0, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfProbeGroups, ChildrenOfABoxAreNotItsProbes) {
    GltfBuilder gltf = box_of_probes({1, 1, 1});
    gltf.json["nodes"][0]["children"] = {gltf.add("nodes", {{"name", "chair"}})};
    EXPECT_EQ(scene_of(gltf).probe_groups.at(0).positions.size(), 1u);
}

TEST(GltfProbeGroups, WrongResolutionsAreRefused) {
    for (const Json& resolution :
         {Json{0, 1, 1}, Json{1, -1, 1}, Json{1, 1, 0.5}, Json{1, 1}, Json{1, 1, "a"},
          Json{4000, 4000, 4000}, Json{1e300, 1e300, 1}, Json(4)}) {
        const auto scene = box_of_probes(resolution).read();
        ASSERT_FALSE(scene) << resolution;
        EXPECT_EQ(scene.error().field, "nodes[0].extras.probe_resolution") << resolution;
        EXPECT_NE(error_text(scene.error()).find("node 0 \"hall\""), std::string::npos);
    }
}

TEST(GltfProbeGroups, TheBoxesOfASceneTogetherHaveALimit) {
    GltfBuilder gltf = box_of_probes({250, 200, 100});
    gltf.add_root(
        {{"name", "yard"},
         {"extras", {{"light_probe_group", true}, {"probe_resolution", {300, 200, 100}}}}});
    const auto scene = gltf.read();
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().field, "nodes[1].extras.probe_resolution");
}

TEST(GltfProbeGroups, FalseIsNoGroup) {
    EXPECT_TRUE(scene_of(group_of_points({{"light_probe_group", false}})).probe_groups.empty());
}

/// A group whose two children are marked by a mesh; the second one has a child of its own.
GltfBuilder group_of_children() {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t chair = gltf.add("nodes", {{"mesh", mesh}, {"name", "chair"}});
    const size_t a = gltf.add("nodes", {{"mesh", mesh}, {"translation", {1, 2, 3}}});
    const size_t b =
        gltf.add("nodes", {{"mesh", mesh}, {"translation", {4, 5, 6}}, {"children", {chair}}});
    gltf.add_root({{"name", "hall"}, {"children", {a, b}}, {"extras", kIsGroup}});
    return gltf;
}

TEST(GltfProbeGroups, ChildrenAreProbesWhereThereAreNoPoints) {
    const Scene scene = scene_of(group_of_children());
    ASSERT_EQ(scene.probe_groups.size(), 1u);
    EXPECT_EQ(scene.probe_groups[0].positions, kTwoPoints);
}

TEST(GltfProbeGroups, ChildrenThatAreProbesAreNoInstances) {
    const Scene scene = scene_of(group_of_children());
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "chair");
}

TEST(GltfProbeGroups, ChildrenOfAGroupOfPointsStayInstances) {
    GltfBuilder gltf = group_of_points();
    const size_t child = gltf.add("nodes", {{"mesh", gltf.add_triangle()}, {"name", "chair"}});
    gltf.json["nodes"][0]["children"] = {child};
    EXPECT_EQ(scene_of(gltf).instances.size(), 1u);
}

TEST(GltfProbeGroups, GroupsInsideGroupsAreNoProbes) {
    GltfBuilder gltf = group_of_children();
    gltf.json["nodes"][2]["extras"] = kIsGroup;
    gltf.json["nodes"][2]["name"] = "niche";
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.probe_groups.size(), 2u);
    EXPECT_EQ(scene.probe_groups[0].positions, (std::vector<glm::dvec3>{{1, 2, 3}}));
    EXPECT_EQ(scene.probe_groups[1].positions, (std::vector<glm::dvec3>{{0, 0, 0}}));
}

TEST(GltfProbeGroups, RejectsAGroupWithoutAName) {
    GltfBuilder gltf = group_of_points();
    gltf.json["nodes"][0].erase("name");
    EXPECT_EQ(gltf.error(), "scene.glb: node 0: is a probe group and has no name");
}

TEST(GltfProbeGroups, RejectsTwoGroupsOfOneName) {
    GltfBuilder gltf = group_of_points();
    gltf.add_root(gltf.json["nodes"][0]);
    EXPECT_EQ(gltf.error(), "scene.glb: group 1: another group is named \"hall\"");
}

TEST(GltfProbeGroups, AGroupMayHaveNoProbes) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "hall"}, {"extras", kIsGroup}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->probe_groups.size(), 1u);
    EXPECT_TRUE(scene->probe_groups[0].positions.empty());
}

TEST(GltfProbeGroups, RejectsAnIndexOutOfRange) {
    GltfBuilder gltf = group_of_points();
    gltf.primitive(0)["indices"] = gltf.add_accessor(std::vector<uint8_t>{2}, "SCALAR", 5121);
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"hall\": mesh 0: primitive 0: index 2 is out of range (2 "
              "vertices)");
}

}  // namespace
}  // namespace tetralight
