// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_instances.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// A triangle under a node that is moved up by 10, with these instancing attributes.
GltfBuilder instanced(const std::function<Json(GltfBuilder&)>& attributes) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const Json extension = {{"attributes", attributes(gltf)}};
    gltf.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    gltf.add_root({{"name", "trees"},
                   {"mesh", mesh},
                   {"translation", {0, 10, 0}},
                   {"extensions", {{"EXT_mesh_gpu_instancing", extension}}}});
    return gltf;
}

std::vector<MeshInstance> instances_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    return scene ? scene->instances : std::vector<MeshInstance>();
}

TEST(GltfInstances, NodesShareAMesh) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.add_root({{"mesh", mesh}, {"name", "a"}});
    gltf.add_root({{"mesh", mesh}, {"name", "b"}});
    const auto instances = instances_of(gltf);
    ASSERT_EQ(instances.size(), 2u);
    EXPECT_EQ(instances[0].mesh, instances[1].mesh);
    EXPECT_EQ(instances[1].name, "b");
}

TEST(GltfInstances, TranslationsAloneAreEnough) {
    const auto instances = instances_of(instanced([](GltfBuilder& gltf) -> Json {
        return {{"TRANSLATION", gltf.add_floats({1, 2, 3, 4, 5, 6}, "VEC3")}};
    }));
    ASSERT_EQ(instances.size(), 2u);
    EXPECT_EQ(instances[0].world_from_mesh[3], glm::dvec4(1, 12, 3, 1));
    EXPECT_EQ(instances[1].world_from_mesh[3], glm::dvec4(4, 15, 6, 1));
    EXPECT_EQ(instances[1].name, "trees");
}

TEST(GltfInstances, ScaleComesBeforeRotation) {
    const float half = std::sqrt(0.5f);
    const auto instances = instances_of(instanced([&](GltfBuilder& gltf) -> Json {
        return {{"ROTATION", gltf.add_floats({0, 0, half, half}, "VEC4")},  // x to y
                {"SCALE", gltf.add_floats({2, 3, 4}, "VEC3")}};
    }));
    ASSERT_EQ(instances.size(), 1u);
    EXPECT_NEAR(instances[0].world_from_mesh[0].y, 2.0, 1e-6);
    EXPECT_NEAR(instances[0].world_from_mesh[1].x, -3.0, 1e-6);
}

TEST(GltfInstances, RotationsMayBeNormalizedBytes) {
    const auto instances = instances_of(instanced([](GltfBuilder& gltf) -> Json {
        const size_t rotation = gltf.add_accessor(std::vector<int8_t>{0, 127, 0, 0}, "VEC4", 5120);
        gltf.json["accessors"][rotation]["normalized"] = true;
        return {{"ROTATION", rotation}};
    }));
    ASSERT_EQ(instances.size(), 1u);
    EXPECT_NEAR(instances[0].world_from_mesh[0].x, -1.0, 1e-6);  // half a turn about +Y
}

TEST(GltfInstances, RejectsAttributesOfDifferentLengths) {
    const auto gltf = instanced([](GltfBuilder& builder) -> Json {
        return {{"TRANSLATION", builder.add_floats({1, 2, 3, 4, 5, 6}, "VEC3")},
                {"SCALE", builder.add_floats({1, 1, 1}, "VEC3")}};
    });
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"trees\": EXT_mesh_gpu_instancing: SCALE has 1 elements, another "
              "attribute has 2");
}

TEST(GltfInstances, RejectsInstancingWithoutAttributes) {
    const auto gltf = instanced([](GltfBuilder&) { return Json::object(); });
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"trees\": EXT_mesh_gpu_instancing: has neither TRANSLATION nor "
              "ROTATION nor SCALE");
}

TEST(GltfInstances, RejectsAZeroRotation) {
    const auto gltf = instanced([](GltfBuilder& builder) -> Json {
        return {{"ROTATION", builder.add_floats({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4")}};
    });
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"trees\": EXT_mesh_gpu_instancing: transform 1 is not finite");
}

/// The warnings, from behind the path.
std::vector<std::string> warnings_of(const GltfBuilder& gltf) {
    std::vector<std::string> lines;
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    if (!scene) return lines;
    for (const std::string& warning : scene->warnings)
        lines.push_back(warning.substr(warning.find("scene.glb: ") + 11));
    return lines;
}

TEST(GltfInstances, LeavesOutATransformThatLosesAnAxis) {
    // A quarter of a turn away, so that no column is zero in the product.
    const double sine = std::sin(std::numbers::pi / 8), cosine = std::cos(std::numbers::pi / 8);
    GltfBuilder gltf;
    const size_t child = gltf.add("nodes", {{"name", "leaf"}, {"mesh", gltf.add_triangle()}});
    gltf.json["nodes"][child]["rotation"] = {0, sine, 0, cosine};
    gltf.add_root({{"scale", {1, 1, 0}}, {"children", {child}}});
    gltf.add_root({{"name", "hidden"}, {"mesh", 0}, {"scale", {0, 0, 0}}});
    gltf.add_root({{"name", "seen"}, {"mesh", 0}});
    const auto instances = instances_of(gltf);
    ASSERT_EQ(instances.size(), 1u);
    EXPECT_EQ(instances[0].name, "seen");
    EXPECT_EQ(warnings_of(gltf),
              std::vector<std::string>{
                  "meshes scaled to 0 (node 0 \"leaf\" and 1 more): are left out: their transforms "
                  "are not invertible; if they are to be seen, give them a scale above 0 on every "
                  "axis"});
}

/// The part of the first row with this name; an empty one if there is none.
ScenePart part_of(const GltfBuilder& gltf, const std::string& name) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene) return {};
    const auto found = std::ranges::find(scene->parts, name, &ScenePart::name);
    return found == scene->parts.end() ? ScenePart() : *found;
}

TEST(GltfInstances, TellsOfAttributesThatAreNotRead) {
    const GltfBuilder gltf = instanced([](GltfBuilder& builder) -> Json {
        return {{"TRANSLATION", builder.add_floats({1, 2, 3}, "VEC3")},
                {"_ID", builder.add_floats({7}, "SCALAR")},
                {"_COLOR_0", builder.add_floats({1, 0, 0}, "VEC3")}};
    });
    const ScenePart id = part_of(gltf, "attribute _ID of instances");
    EXPECT_EQ(id.use, PartUse::Ignored);
    EXPECT_EQ(id.elements, std::vector<std::string>{"node 0 \"trees\""});
    EXPECT_FALSE(id.changes_light);
    EXPECT_TRUE(part_of(gltf, "attribute _COLOR_0 of instances").changes_light);
    EXPECT_EQ(part_of(gltf, "attribute TRANSLATION of instances").count, 0u);
}

TEST(GltfInstances, ASkinnedMeshStandsOnceAndThatIsTold) {
    GltfBuilder gltf = instanced([](GltfBuilder& builder) -> Json {
        return {{"TRANSLATION", builder.add_floats({1, 2, 3, 4, 5, 6}, "VEC3")}};
    });
    EXPECT_EQ(part_of(gltf, "instances of a node with a skin").count, 0u);
    Json& attributes = gltf.primitive(0)["attributes"];
    attributes["JOINTS_0"] = gltf.add_accessor(std::vector<uint8_t>(12, 0), "VEC4", 5121);
    attributes["WEIGHTS_0"] = gltf.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    gltf.add("skins", {{"joints", {0}}});
    gltf.json["nodes"][0]["skin"] = 0;
    EXPECT_EQ(instances_of(gltf).size(), 1u);
    const ScenePart part = part_of(gltf, "instances of a node with a skin");
    EXPECT_EQ(part.elements, std::vector<std::string>{"node 0 \"trees\""});
    EXPECT_TRUE(part.changes_light);
}

TEST(GltfInstances, SmallAndUnevenScalesAreInvertible) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}, {"scale", {1e-6, 1e-6, 1e-6}}});
    gltf.add_root({{"mesh", 0}, {"scale", {1000, 1e-3, -1}}});
    EXPECT_EQ(instances_of(gltf).size(), 2u);
}

TEST(GltfInstances, NodesWithoutAMeshMayLoseAxes) {
    GltfBuilder gltf;
    gltf.add_root({{"scale", {0, 0, 0}}});
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    EXPECT_EQ(instances_of(gltf).size(), 1u);
}

TEST(GltfInstances, LeavesOutAnInstanceThatLosesAnAxis) {
    const auto gltf = instanced([](GltfBuilder& builder) -> Json {
        return {{"SCALE", builder.add_floats({1, 1, 1, 1, 0, 1, 2, 1, 1}, "VEC3")}};
    });
    const auto instances = instances_of(gltf);
    ASSERT_EQ(instances.size(), 2u);
    EXPECT_EQ(instances[1].world_from_mesh[0].x, 2.0);
    const auto warnings = warnings_of(gltf);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(warnings[0].starts_with("meshes scaled to 0 (node 0 \"trees\" instance 1): "))
        << warnings[0];
}

TEST(GltfInstances, RejectsATranslationThatIsNotFinite) {
    const auto gltf = instanced([](GltfBuilder& builder) -> Json {
        const float infinity = std::numeric_limits<float>::infinity();
        return {{"TRANSLATION", builder.add_floats({0, 0, infinity}, "VEC3")}};
    });
    EXPECT_EQ(gltf.error(),
              "scene.glb: node 0 \"trees\": EXT_mesh_gpu_instancing: TRANSLATION: accessor 1: "
              "element 0 is not finite (component 2 is inf)");
}

}  // namespace
}  // namespace tetralight
