// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_instances.h>
#include <tetralight/bake/scene/detail/gltf_pose.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/bake/scene/gltf_document_builder.h"

namespace tetralight {
namespace {

using Document = detail::GltfDocument;
using Positions = std::vector<glm::vec3>;

/// Two triangles of a strip of width 1 along +Y, from y = 0 to y = 2, with normals +Z. Vertices 0
/// and 1 are at y = 0, 2 and 3 at y = 2.
Document strip() {
    Document document;
    detail::GltfPrimitive primitive;
    primitive.attributes["POSITION"] =
        add_floats(document, {0, 0, 0, 1, 0, 0, 0, 2, 0, 1, 2, 0}, 3);
    primitive.attributes["NORMAL"] = add_floats(document, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    primitive.attributes["TANGENT"] =
        add_floats(document, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
    primitive.indices = add_elements(document, std::vector<uint16_t>{0, 1, 2, 2, 1, 3}, 5123, 1);
    document.meshes = {{"bar", {primitive}, {}}};
    document.nodes.resize(1);
    document.nodes[0].name = "hero";
    document.nodes[0].mesh = 0;
    return document;
}

detail::GltfPrimitive& primitive_of(Document& document) {
    return document.meshes[0].primitives[0];
}

/// Target 0 moves everything by (0, 0, 3), target 1 the upper vertices by (2, 0, 0).
Document morphed(const std::vector<double>& weights) {
    Document document = strip();
    primitive_of(document).targets = {
        {{"POSITION", add_floats(document, {0, 0, 3, 0, 0, 3, 0, 0, 3, 0, 0, 3}, 3)}},
        {{"POSITION", add_floats(document, {0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0, 0}, 3)}}};
    document.nodes[0].weights = weights;
    return document;
}

/// The lower vertices follow joint 0 (node 1, at the origin), the upper ones joint 1 (node 2, a
/// child of node 1 at y = 1).
Document skinned() {
    Document document = strip();
    detail::GltfPrimitive& primitive = primitive_of(document);
    primitive.attributes["JOINTS_0"] = add_elements(
        document, std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, 4);
    primitive.attributes["WEIGHTS_0"] =
        add_floats(document, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
    document.nodes.resize(3);
    document.nodes[0].skin = 0;
    document.nodes[1].name = "root";
    document.nodes[1].children = {2};
    document.nodes[2].name = "tip";
    document.nodes[2].parent_from_node[3] = glm::dvec4(0, 1, 0, 1);
    const uint32_t bind = add_floats(document, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                                     16);
    document.skins = {{"rig", {1, 2}, bind}};
    return document;
}

/// Turns the tip by a quarter about +X: from +Y to +Z.
void bend(Document& document) {
    const double half = std::sqrt(0.5);
    document.nodes[2].parent_from_node =
        detail::compose_transform({0, 1, 0}, glm::dquat(half, half, 0, 0), glm::dvec3(1));
}

struct Posed {
    detail::GltfMeshes meshes;
    std::vector<MeshInstance> instances;
};

Result<Posed> pose(const Document& document) {
    const auto nodes = detail::flatten_nodes(document);
    if (!nodes) return nodes.error();
    auto meshes = detail::read_meshes(document, NormalMaps::Read);
    if (!meshes) return meshes.error();
    const auto status = detail::pose_meshes(document, *nodes, NormalMaps::Read, *meshes);
    if (!status) return status.error();
    const std::vector<bool> is_probe(document.nodes.size(), false);
    detail::PartList parts;
    auto instances = detail::read_instances(document, *nodes, is_probe, *meshes, parts);
    if (!instances) return instances.error();
    return Posed{std::move(*meshes), std::move(*instances)};
}

/// The one instance of a document, and its mesh.
struct OneInstance {
    Mesh mesh;
    MeshInstance instance;
};

OneInstance pose_one(const Document& document) {
    const auto posed = pose(document);
    EXPECT_TRUE(posed) << error_text(posed.error());
    if (!posed) return {};
    EXPECT_EQ(posed->instances.size(), 1u);
    if (posed->instances.size() != 1) return {};
    return {posed->meshes.meshes[posed->instances[0].mesh], posed->instances[0]};
}

void expect_near(const Positions& actual, const Positions& expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (size_t i = 0; i < actual.size(); ++i) {
        EXPECT_LT(glm::distance(actual[i], expected[i]), 1e-6f) << i;
    }
}

TEST(GltfPose, NodesWithoutWeightsShareTheMeshOfTheFile) {
    for (const auto& weights : {std::vector<double>{}, {0, 0}, {0}, {0, 0, 5}}) {
        const auto posed = pose(morphed(weights));
        ASSERT_TRUE(posed) << error_text(posed.error());
        EXPECT_EQ(posed->meshes.meshes.size(), 1u);
        EXPECT_TRUE(posed->meshes.posed_meshes_of.empty());
        EXPECT_EQ(posed->instances[0].lightmap.receive_gi, ReceiveGi::Lightmap);
    }
}

TEST(GltfPose, MorphTargetsMoveVerticesByTheirDifferences) {
    const auto one = pose_one(morphed({1, 0}));
    EXPECT_EQ(one.mesh.positions, (Positions{{0, 0, 3}, {1, 0, 3}, {0, 2, 3}, {1, 2, 3}}));
    EXPECT_EQ(one.instance.lightmap.receive_gi, ReceiveGi::Probes);
}

TEST(GltfPose, MorphTargetsAdd) {
    const auto one = pose_one(morphed({-1, 0.5}));
    EXPECT_EQ(one.mesh.positions, (Positions{{0, 0, -3}, {1, 0, -3}, {1, 2, -3}, {2, 2, -3}}));
}

TEST(GltfPose, WeightsOfTheMeshApplyWithoutThoseOfTheNode) {
    Document document = morphed({});
    document.meshes[0].weights = {0, 1};
    EXPECT_EQ(pose_one(document).mesh.positions,
              (Positions{{0, 0, 0}, {1, 0, 0}, {2, 2, 0}, {3, 2, 0}}));
    document.nodes[0].weights = {1, 0};
    EXPECT_EQ(pose_one(document).mesh.positions[0], glm::vec3(0, 0, 3));
}

TEST(GltfPose, MorphedNormalsAndTangentsAreNormalized) {
    Document document = morphed({1, 0});
    auto& target = primitive_of(document).targets[0];
    target["NORMAL"] = add_floats(document, {0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, -1}, 3);
    target["TANGENT"] = add_floats(document, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 3);
    const auto one = pose_one(document);
    const float half = std::sqrt(0.5f);
    expect_near(one.mesh.normals, {{0, half, half}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
    EXPECT_NEAR(one.mesh.tangents[0].y, half, 1e-6f);
    EXPECT_EQ(one.mesh.tangents[0].w, 1.0f);
}

TEST(GltfPose, MorphedMeshesKeepTheTransformOfTheirNode) {
    Document document = morphed({1, 0});
    document.nodes[0].parent_from_node[3] = glm::dvec4(5, 6, 7, 1);
    EXPECT_EQ(pose_one(document).instance.world_from_mesh, document.nodes[0].parent_from_node);
}

TEST(GltfPose, ASkinInItsBindPoseChangesNothing) {
    const auto one = pose_one(skinned());
    EXPECT_EQ(one.mesh.positions, (Positions{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}}));
    EXPECT_EQ(one.mesh.normals, Positions(4, glm::vec3(0, 0, 1)));
    EXPECT_EQ(one.instance.lightmap.receive_gi, ReceiveGi::Probes);
}

TEST(GltfPose, AJointBendsABar) {
    Document document = skinned();
    bend(document);
    const auto one = pose_one(document);
    // The upper end is 1 above the joint at y = 1; bent it is 1 in front of it.
    expect_near(one.mesh.positions, {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {1, 1, 1}});
    expect_near(one.mesh.normals, {{0, 0, 1}, {0, 0, 1}, {0, -1, 0}, {0, -1, 0}});
    EXPECT_EQ(one.mesh.indices, (std::vector<uint32_t>{0, 1, 2, 2, 1, 3}));
}

TEST(GltfPose, VerticesOfTwoJointsLieBetween) {
    Document document = skinned();
    bend(document);
    auto& attributes = primitive_of(document).attributes;
    attributes["JOINTS_0"] = add_elements(
        document, std::vector<uint16_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5123, 4);
    // Weights of the upper vertices are 1 to 3, with sums 4 and 0.4.
    attributes["WEIGHTS_0"] =
        add_floats(document, {1, 0, 0, 0, 1, 0, 0, 0, 1, 3, 0, 0, 0.1f, 0.3f, 0, 0}, 4);
    const glm::vec3 between = 0.25f * glm::vec3(0, 2, 0) + 0.75f * glm::vec3(0, 1, 1);
    const auto one = pose_one(document);
    expect_near({one.mesh.positions[2], one.mesh.positions[3]},
                {between, between + glm::vec3(1, 0, 0)});
}

TEST(GltfPose, TheSecondSetOfJointsCounts) {
    Document document = skinned();
    bend(document);
    auto& attributes = primitive_of(document).attributes;
    attributes["JOINTS_1"] = add_elements(document, std::vector<uint8_t>(16, 0), 5121, 4);
    attributes["WEIGHTS_1"] =
        add_floats(document, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4);
    const auto one = pose_one(document);
    expect_near({one.mesh.positions[2]}, {0.5f * glm::vec3(0, 2, 0) + 0.5f * glm::vec3(0, 1, 1)});
    expect_near({one.mesh.positions[3]}, {{1, 1, 1}});
}

TEST(GltfPose, VerticesWithoutWeightsFollowTheirFirstJoint) {
    Document document = skinned();
    bend(document);
    primitive_of(document).attributes["WEIGHTS_0"] =
        add_floats(document, std::vector<float>(16, 0.0f), 4);
    expect_near(pose_one(document).mesh.positions, {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {1, 1, 1}});
}

TEST(GltfPose, SkinnedMeshesIgnoreTheTransformsOfTheirNode) {
    Document document = skinned();
    document.nodes[0].parent_from_node = glm::dmat4(0.0);  // flat, which others may not be
    document.nodes[0].parent_from_node[3].w = 1.0;
    const uint32_t translations = add_floats(document, {1, 2, 3, 4, 5, 6}, 3);
    document.nodes[0].instancing = detail::GltfAttributes{{"TRANSLATION", translations}};
    const auto one = pose_one(document);
    EXPECT_EQ(one.instance.world_from_mesh, glm::dmat4(1.0));
    EXPECT_EQ(one.mesh.positions[3], glm::vec3(1, 2, 0));
}

TEST(GltfPose, WithoutBindMatricesVerticesAreInTheSpaceOfTheirJoints) {
    Document document = skinned();
    document.skins[0].inverse_bind_matrices = kNoIndex;
    document.nodes[1].parent_from_node[3] = glm::dvec4(10, 0, 0, 1);
    EXPECT_EQ(pose_one(document).mesh.positions,
              (Positions{{10, 0, 0}, {11, 0, 0}, {10, 3, 0}, {11, 3, 0}}));
}

TEST(GltfPose, MorphTargetsComeBeforeTheSkin) {
    Document document = skinned();
    bend(document);
    primitive_of(document).targets = {
        {{"POSITION", add_floats(document, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}, 3)}}};
    document.nodes[0].weights = {1};
    // The upper end is 2 above the joint now.
    expect_near(pose_one(document).mesh.positions, {{0, 0, 0}, {1, 0, 0}, {0, 1, 2}, {1, 1, 2}});
}

TEST(GltfPose, NormalsStayPerpendicularToAScaledSurface) {
    Document document = skinned();
    const float half = std::sqrt(0.5f);
    Positions slope = {{0, 0, 0}, {1, 0, 0}, {0, 2, 2}, {1, 2, 2}};
    std::vector<float> numbers, normals;
    for (const glm::vec3& p : slope) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {0, -half, half});
    primitive_of(document).attributes["POSITION"] = add_floats(document, numbers, 3);
    primitive_of(document).attributes["NORMAL"] = add_floats(document, normals, 3);
    document.nodes[1].parent_from_node = detail::compose_transform({}, {1, 0, 0, 0}, {1, 1, 3});
    const auto one = pose_one(document);
    const glm::vec3 edge = one.mesh.positions[2] - one.mesh.positions[0];
    EXPECT_NEAR(glm::dot(one.mesh.normals[0], edge), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::length(one.mesh.normals[0]), 1.0f, 1e-6f);
    EXPECT_GT(one.mesh.normals[0].z, 0.0f);
}

TEST(GltfPose, AMirroredSkinKeepsItsFront) {
    Document document = skinned();
    document.nodes[1].parent_from_node = detail::compose_transform({}, {1, 0, 0, 0}, {-1, 1, 1});
    const Mesh mesh = pose_one(document).mesh;
    const auto corner = [&](size_t i) { return mesh.positions[mesh.indices[i]]; };
    const glm::vec3 front = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    EXPECT_GT(glm::dot(front, mesh.normals[0]), 0.0f);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    // The bitangent w · (normal × tangent) was +Y, which the mirror keeps.
    const glm::vec4& tangent = mesh.tangents[0];
    EXPECT_EQ(tangent.w * glm::cross(mesh.normals[0], glm::vec3(tangent)), glm::vec3(0, 1, 0));
}

TEST(GltfPose, ASkinWithoutJointsAndWeightsIsLeftOut) {
    Document document = skinned();
    primitive_of(document).attributes.erase("JOINTS_0");
    primitive_of(document).attributes.erase("WEIGHTS_0");
    document.nodes[0].parent_from_node[3] = glm::dvec4(5, 6, 7, 1);
    const auto one = pose_one(document);
    EXPECT_EQ(one.instance.world_from_mesh, document.nodes[0].parent_from_node);
    EXPECT_EQ(one.instance.lightmap.receive_gi, ReceiveGi::Lightmap);
}

TEST(GltfPose, NodesWithEqualPosesShareMeshes) {
    Document document = morphed({1, 0});
    document.nodes.resize(3, document.nodes[0]);
    document.nodes[2].weights = {0, 1};
    const auto posed = pose(document);
    ASSERT_TRUE(posed) << error_text(posed.error());
    EXPECT_EQ(posed->meshes.meshes.size(), 3u);  // the file's, and two poses
    EXPECT_EQ(posed->instances[0].mesh, posed->instances[1].mesh);
    EXPECT_NE(posed->instances[0].mesh, posed->instances[2].mesh);
}

TEST(GltfPose, HiddenNodesAreNotPosed) {
    Document document = skinned();
    document.nodes[0].is_visible = false;
    document.skins[0].joints = {};
    const auto posed = pose(document);
    ASSERT_TRUE(posed) << error_text(posed.error());
    EXPECT_TRUE(posed->meshes.posed_meshes_of.empty());
    EXPECT_TRUE(posed->instances.empty());
}

TEST(GltfPose, TooManyDeformedVerticesAreUnsupported) {
    Document document = morphed({1, 0});
    detail::GltfMeshes meshes = *detail::read_meshes(document, NormalMaps::Skip);
    const auto nodes = detail::flatten_nodes(document);
    document.accessors[0].count = (uint64_t{1} << 28) + 1;
    const auto status = detail::pose_meshes(document, *nodes, NormalMaps::Skip, meshes);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Unsupported);
}

/// A change of a skinned document, and the error that it has to give.
struct PoseRejection {
    const char* label;
    std::function<void(Document&, detail::GltfAttributes&)> change;
    const char* error;
    const char* field;
};

class GltfPoseRejects : public testing::TestWithParam<PoseRejection> {};

TEST_P(GltfPoseRejects, WithPlaceAndValue) {
    Document document = skinned();
    GetParam().change(document, primitive_of(document).attributes);
    const auto posed = pose(document);
    ASSERT_FALSE(posed);
    EXPECT_EQ(error_text(posed.error()), std::string("node 0 \"hero\": ") + GetParam().error);
    EXPECT_EQ(posed.error().field, GetParam().field);
}

using Attributes = detail::GltfAttributes;

INSTANTIATE_TEST_SUITE_P(
    All, GltfPoseRejects,
    testing::Values(
        PoseRejection{"NoJoints", [](Document&, Attributes& a) { a.erase("JOINTS_0"); },
                      "mesh 0 \"bar\": primitive 0: has no JOINTS_0, which its skin needs",
                      "meshes[0].primitives[0].attributes.JOINTS_0"},
        PoseRejection{"NoSecondWeights",
                      [](Document&, Attributes& a) { a["JOINTS_1"] = a["JOINTS_0"]; },
                      "mesh 0 \"bar\": primitive 0: has no WEIGHTS_1, which its skin needs",
                      "meshes[0].primitives[0].attributes.WEIGHTS_1"},
        PoseRejection{"WeightCount",
                      [](Document& d, Attributes& a) {
                          a["WEIGHTS_0"] = add_floats(d, {1, 0, 0, 0}, 4);
                      },
                      "mesh 0 \"bar\": primitive 0: WEIGHTS_0 has 1 elements, POSITION has 4",
                      "meshes[0].primitives[0].attributes.WEIGHTS_0"},
        PoseRejection{"JointRange", [](Document& d, Attributes&) { d.skins[0].joints.pop_back(); },
                      "mesh 0 \"bar\": primitive 0: JOINTS_0: joint 1 of vertex 2 is out of range "
                      "(1 joints)",
                      "meshes[0].primitives[0].attributes.JOINTS_0"},
        PoseRejection{"NegativeWeight",
                      [](Document& d, Attributes& a) {
                          std::vector<float> weights(16, 1.0f);
                          weights[6] = -0.5f;
                          a["WEIGHTS_0"] = add_floats(d, weights, 4);
                      },
                      "mesh 0 \"bar\": primitive 0: WEIGHTS_0: weight -0.5 of vertex 1 is negative",
                      "meshes[0].primitives[0].attributes.WEIGHTS_0"},
        PoseRejection{"JointOutsideOfTheScene",
                      [](Document& d, Attributes&) {
                          d.nodes[1].children.clear();
                          d.scene_roots = {{0, 1}};
                      },
                      "skin 0 \"rig\": joint 1 (node 2 \"tip\") is not in the scene",
                      "skins[0].joints[1]"},
        PoseRejection{"BindMatrixCount",
                      [](Document& d, Attributes&) { d.skins[0].joints.push_back(1); },
                      "skin 0 \"rig\": inverseBindMatrices has 2 matrices for 3 joints",
                      "skins[0].inverseBindMatrices"},
        PoseRejection{
            "BindMatrixType",
            [](Document& d, Attributes& a) { d.skins[0].inverse_bind_matrices = a["POSITION"]; },
            "skin 0 \"rig\": inverseBindMatrices: accessor 0: is not of type MAT4",
            "accessors[0].type"},
        PoseRejection{"TargetCount",
                      [](Document& d, Attributes&) {
                          primitive_of(d).targets = {{{"POSITION", add_floats(d, {1, 2, 3}, 3)}}};
                          d.nodes[0].weights = {1};
                      },
                      "mesh 0 \"bar\": primitive 0: morph target 0: POSITION has 1 elements, the "
                      "primitive has 4",
                      "meshes[0].primitives[0].targets[0].POSITION"},
        PoseRejection{"Infinite",
                      [](Document& d, Attributes&) {
                          d.nodes[1].parent_from_node[3] = glm::dvec4(1e300, 0, 0, 1);
                      },
                      "mesh 0 \"bar\": primitive 0: POSITION: vertex 0 is moved to (inf, 0, 0), "
                      "which is not finite",
                      "meshes[0].primitives[0].attributes.POSITION"}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

}  // namespace
}  // namespace tetralight
