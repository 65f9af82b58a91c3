// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

const double kHalf = std::sqrt(0.5);

/// The scene of a builder; a default one, and a failed test, where it cannot be read.
Scene scene_of(const GltfBuilder& gltf) {
    auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    return scene ? std::move(*scene) : Scene{};
}

void expect_near(const glm::dvec4& actual, const glm::dvec4& expected) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-12) << i;
}

TEST(GltfNodes, AppliesScaleThenRotationThenTranslation) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()},
                   {"translation", {10, 20, 30}},
                   {"rotation", {0, 0, kHalf, kHalf}},  // 90 degrees about +Z: x to y
                   {"scale", {2, 3, 4}}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.instances.size(), 1u);
    expect_near(scene.instances[0].world_from_mesh * glm::dvec4(1, 0, 0, 1), {10, 22, 30, 1});
    expect_near(scene.instances[0].world_from_mesh * glm::dvec4(0, 1, 0, 1), {7, 20, 30, 1});
}

TEST(GltfNodes, ChildrenAreInTheirParentsSpace) {
    GltfBuilder gltf;
    const size_t child = gltf.add(
        "nodes", {{"mesh", gltf.add_triangle()}, {"name", "child"}, {"translation", {1, 0, 0}}});
    gltf.add_root({{"scale", {5, 5, 5}}, {"translation", {0, 7, 0}}, {"children", {child}}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "child");
    expect_near(scene.instances[0].world_from_mesh[3], {5, 7, 0, 1});
}

TEST(GltfNodes, MatrixIsColumnMajorAndMayMirror) {
    GltfBuilder gltf;
    const Json matrix = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1};
    gltf.add_root({{"mesh", gltf.add_triangle()}, {"matrix", matrix}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].world_from_mesh[0], glm::dvec4(-1, 0, 0, 0));
    EXPECT_EQ(scene.instances[0].world_from_mesh[3], glm::dvec4(3, 4, 5, 1));
}

TEST(GltfNodes, OnlyTheDefaultSceneIsRead) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.add_root({{"mesh", mesh}, {"name", "first"}});
    gltf.json["scenes"].push_back(
        {{"nodes", {gltf.add("nodes", {{"mesh", mesh}, {"name", "second"}})}}});
    EXPECT_EQ(scene_of(gltf).instances[0].name, "first");
    gltf.json["scene"] = 1;
    EXPECT_EQ(scene_of(gltf).instances[0].name, "second");
}

TEST(GltfNodes, FirstSceneIsTheDefault) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    gltf.json.erase("scene");
    EXPECT_EQ(scene_of(gltf).instances.size(), 1u);
}

TEST(GltfNodes, WithoutScenesAllRootsAreRead) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    gltf.json.erase("scene");
    gltf.json.erase("scenes");
    EXPECT_EQ(scene_of(gltf).instances.size(), 1u);
}

TEST(GltfNodes, ContributeGiIsInheritedAndCanBeSetAgain) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t back = gltf.add(
        "nodes", {{"mesh", mesh}, {"name", "back"}, {"extras", {{"contribute_gi", true}}}});
    const size_t arm = gltf.add("nodes", {{"mesh", mesh}, {"name", "arm"}, {"children", {back}}});
    gltf.add_root({{"mesh", mesh},
                   {"name", "robot"},
                   {"children", {arm}},
                   {"extras", {{"contribute_gi", false}}}});
    gltf.add_root({{"mesh", mesh}, {"name", "wall"}});
    std::vector<std::pair<std::string, bool>> found;
    for (const auto& instance : scene_of(gltf).instances) {
        found.emplace_back(instance.name, instance.contributes_gi);
    }
    const std::vector<std::pair<std::string, bool>> expected = {
        {"robot", false}, {"arm", false}, {"back", true}, {"wall", true}};
    EXPECT_EQ(found, expected);
}

TEST(GltfNodes, WalkableIsInheritedAndCanBeSetAgain) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t pond =
        gltf.add("nodes", {{"mesh", mesh}, {"name", "pond"}, {"extras", {{"walkable", false}}}});
    const size_t lawn = gltf.add("nodes", {{"mesh", mesh}, {"name", "lawn"}, {"children", {pond}}});
    gltf.add_root(
        {{"mesh", mesh}, {"name", "park"}, {"children", {lawn}}, {"extras", {{"walkable", true}}}});
    gltf.add_root({{"mesh", mesh}, {"name", "wall"}});
    std::vector<std::pair<std::string, bool>> found;
    for (const auto& instance : scene_of(gltf).instances) {
        found.emplace_back(instance.name, instance.is_walkable);
        EXPECT_TRUE(instance.contributes_gi) << instance.name;
    }
    const std::vector<std::pair<std::string, bool>> expected = {
        {"park", true}, {"lawn", true}, {"pond", false}, {"wall", false}};
    EXPECT_EQ(found, expected);
}

TEST(GltfNodes, RejectsWalkableThatIsNoBoolean) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}, {"extras", {{"walkable", "yes"}}}});
    EXPECT_EQ(gltf.error(), "scene.glb: node 0: extras/walkable is not a boolean (\"yes\")");
}

TEST(GltfNodes, LightmapExtrasAreInheritedAndCanBeSetAgain) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t lid =
        gltf.add("nodes", {{"mesh", mesh},
                           {"name", "lid"},
                           {"extras", {{"receive_gi", "lightmap"}, {"lightmap_scale", 0}}}});
    gltf.add_root(
        {{"mesh", mesh},
         {"name", "box"},
         {"children", {lid}},
         {"extras", {{"receive_gi", "probes"}, {"lightmap_scale", 2.5}, {"stitch_seams", false}}}});
    gltf.add_root({{"mesh", mesh}, {"name", "wall"}});
    std::vector<LightmapUse> found;
    for (const auto& instance : scene_of(gltf).instances) found.push_back(instance.lightmap);
    const std::vector<LightmapUse> expected = {{ReceiveGi::Probes, 2.5f, false},
                                               {ReceiveGi::Lightmap, 0.0f, false},
                                               {ReceiveGi::Lightmap, 1.0f, true}};
    EXPECT_EQ(found, expected);
}

TEST(GltfNodes, RejectsLightmapExtrasThatAreOutOfRange) {
    const auto error_of = [](const Json& extras) {
        GltfBuilder gltf;
        gltf.add_root({{"mesh", gltf.add_triangle()}, {"extras", extras}});
        return gltf.error();
    };
    EXPECT_EQ(error_of({{"receive_gi", "map"}}),
              "scene.glb: node 0: extras.receive_gi is \"map\", not \"lightmap\" or \"probes\"");
    EXPECT_EQ(error_of({{"lightmap_scale", -1}}),
              "scene.glb: node 0: extras.lightmap_scale is -1, not a number from 0 to 1000000");
    EXPECT_EQ(error_of({{"lightmap_scale", "2"}}),
              "scene.glb: node 0: extras/lightmap_scale is not a number (\"2\")");
    EXPECT_EQ(error_of({{"stitch_seams", 2}}),
              "scene.glb: node 0: extras/stitch_seams is not a boolean (2)");
}

TEST(GltfNodes, AHundredThousandDeepIsNoLimit) {
    GltfBuilder gltf;
    constexpr size_t kDepth = 100000;
    const size_t mesh = gltf.add_triangle();
    Json nodes = Json::array();
    for (size_t i = 0; i + 1 < kDepth; ++i) {
        nodes.push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    }
    nodes.push_back({{"mesh", mesh}});
    gltf.json["nodes"] = std::move(nodes);
    gltf.json["scenes"] = {{{"nodes", {0}}}};
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].world_from_mesh[3].x, static_cast<double>(kDepth - 1));
}

TEST(GltfNodes, RejectsTwoParents) {
    GltfBuilder gltf;
    const size_t shared = gltf.add("nodes", {{"name", "shared"}});
    gltf.add_root({{"children", {shared}}});
    gltf.add_root({{"children", {shared}}});
    EXPECT_EQ(gltf.error(), "scene.glb: node 0 \"shared\": has two parents, nodes 1 and 2");
}

TEST(GltfNodes, RejectsACycle) {
    GltfBuilder gltf;
    gltf.add("nodes", {{"children", {1}}});
    gltf.add("nodes", {{"children", {0}}});
    gltf.add_root({{"name", "root"}});
    EXPECT_EQ(gltf.error(), "scene.glb: node 0: is part of a cycle of nodes");
}

TEST(GltfNodes, RejectsANodeThatIsItsOwnChild) {
    GltfBuilder gltf;
    gltf.add("nodes", {{"children", {0}}});
    EXPECT_EQ(gltf.error(), "scene.glb: node 0: is part of a cycle of nodes");
}

TEST(GltfNodes, RejectsARootThatIsAChild) {
    GltfBuilder gltf;
    const size_t child = gltf.add_root({{"name", "child"}});
    gltf.add_root({{"children", {child}}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"child\": is a root of the scene and a child of node 1");
}

TEST(GltfNodes, RejectsARootThatStandsTwice) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "wall"}});
    gltf.json["scenes"][0]["nodes"].push_back(0);
    EXPECT_EQ(gltf.error(), "scene.glb: node 0 \"wall\": stands twice in the scene");
}

TEST(GltfNodes, RejectsTransformsThatAreNotFiniteOrAffine) {
    const Json projective = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const Json bad_nodes[] = {{{"matrix", projective}}};
    for (const Json& node : bad_nodes) {
        GltfBuilder gltf;
        gltf.add_root(node);
        EXPECT_EQ(gltf.error(), "scene.glb: node 0: transform is not finite or not affine");
    }
}

TEST(GltfNodes, RejectsAHierarchyThatOverflows) {
    GltfBuilder gltf;
    const size_t child = gltf.add("nodes", {{"name", "far"}, {"scale", {1e200, 1, 1}}});
    gltf.add_root({{"scale", {1e200, 1, 1}}, {"children", {child}}});
    EXPECT_EQ(gltf.error(), "scene.glb: node 0 \"far\": transform is not finite or not affine");
}

TEST(GltfNodes, RejectsARotationOfLength0) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "door"}, {"rotation", {0, 0, 0, 0}}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"door\": rotation (0, 0, 0, 0) is a quaternion of length 0");
}

TEST(GltfNodes, SkinsAreLeftOutWithAWarning) {
    GltfBuilder gltf;
    gltf.json["skins"] = {{{"joints", {0}}}};
    gltf.add_root({{"name", "person"}, {"mesh", gltf.add_triangle()}, {"skin", 0}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("node 0 \"person\"): are left out"), std::string::npos);
}

TEST(GltfNodes, ProxyVolumesAreInheritedUntilAChildDeclines) {
    GltfBuilder gltf;
    const size_t own = gltf.add("nodes", {{"mesh", gltf.add_triangle()}, {"name", "own"}});
    const size_t other = gltf.add("nodes", {{"mesh", gltf.add_triangle()},
                                            {"name", "other"},
                                            {"extras", {{"light_probes", "blend"}}}});
    gltf.add_root({{"name", "top"},
                   {"translation", {1, 2, 3}},
                   {"children", {own, other}},
                   {"extras", {{"light_probes", "proxy_volume"}}}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.nodes.size(), 3u);
    EXPECT_EQ(scene.nodes[0].name, "top");
    EXPECT_EQ(scene.nodes[0].parent, kNoIndex);
    EXPECT_EQ(scene.nodes[0].world_from_node[3], glm::dvec4(1, 2, 3, 1));
    EXPECT_EQ(scene.nodes[1].parent, 0u);
    EXPECT_EQ(scene.nodes[1].light_probes, LightProbeUsage::ProxyVolume);
    EXPECT_EQ(scene.nodes[2].light_probes, LightProbeUsage::Blend);
    EXPECT_EQ(scene.nodes[scene.instances[1].node].name, "other");
}

TEST(GltfNodes, RefusesUnknownUsesOfProbes) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "a"}, {"extras", {{"light_probes", "grid"}}}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"a\": extras.light_probes is \"grid\", not \"off\", \"blend\" or "
              "\"proxy_volume\"");
}

TEST(GltfNodes, AnchorsAreInheritedAndFoundByName) {
    GltfBuilder gltf;
    const size_t wheel = gltf.add("nodes", {{"name", "wheel"}, {"mesh", gltf.add_triangle()}});
    const size_t lamp = gltf.add(
        "nodes",
        {{"name", "lamp"}, {"mesh", gltf.add_triangle()}, {"extras", {{"light_probes", "off"}}}});
    gltf.add_root(
        {{"name", "car"}, {"children", {wheel, lamp}}, {"extras", {{"probe_anchor", "roof"}}}});
    gltf.add_root({{"name", "roof"}, {"translation", {1, 2, 3}}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.nodes.size(), 4u);
    const uint32_t roof = scene.nodes[0].probe_anchor;
    ASSERT_LT(roof, 4u);
    EXPECT_EQ(scene.nodes[roof].world_from_node[3], glm::dvec4(1, 2, 3, 1));
    EXPECT_EQ(scene.nodes[1].probe_anchor, roof);
    EXPECT_EQ(scene.nodes[2].light_probes, LightProbeUsage::Off);
    EXPECT_EQ(scene.nodes[roof].probe_anchor, kNoIndex);
}

TEST(GltfNodes, RefusesAnchorsThatAreNotOneNode) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "twin"}});
    gltf.add_root({{"name", "twin"}});
    gltf.add_root({{"name", "car"}, {"extras", {{"probe_anchor", "twin"}}}});
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 2 \"car\": extras.probe_anchor is \"twin\", which several nodes are "
              "called");
    GltfBuilder lone;
    lone.add_root({{"name", "car"}, {"extras", {{"probe_anchor", "roof"}}}});
    EXPECT_EQ(
        lone.error(),
        "scene.glb: node 0 \"car\": extras.probe_anchor is \"roof\", which no node is called");
}

}  // namespace
}  // namespace tetralight
