// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_pose.h>

#include <cmath>
#include <compare>
#include <map>
#include <vector>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_morph.h>
#include <tetralight/bake/scene/detail/gltf_skin.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Vertices of deformed meshes: limited, so that a small file with many nodes cannot fill memory.
constexpr uint64_t kMaxPosedVertices = uint64_t{1} << 28;

/// What deforms a mesh. Nodes with equal poses have equal meshes.
struct Pose {
    uint32_t mesh = kNoIndex;
    uint32_t skin = kNoIndex;
    /// Empty: no morph targets.
    std::vector<double> weights;

    auto operator<=>(const Pose&) const = default;
};

using PosedMeshes = std::map<Pose, std::vector<uint32_t>>;

Status check_positions(const Mesh& mesh) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        return Error{ErrorCode::Corrupt, ".attributes.POSITION", "",
                     str_cat("POSITION: vertex ", i, " is moved to (", p.x, ", ", p.y, ", ", p.z,
                             "), which is not finite")};
    }
    return Ok{};
}

Result<Mesh> posed_primitive(const GltfDocument& document, const GltfPrimitive& primitive,
                             NormalMaps normal_maps, const Pose& pose,
                             std::span<const glm::dmat4> joints) {
    auto mesh = read_primitive(document, primitive, normal_maps);
    if (!mesh) return mesh;
    auto status = apply_morph_targets(document, primitive, pose.weights, *mesh);
    if (!status) return status.error();
    if (pose.skin != kNoIndex) {
        status = apply_skin(document, primitive, joints, *mesh);
        if (!status) return status.error();
    }
    status = check_positions(*mesh);
    if (!status) return status.error();
    return mesh;
}

/// Adds the meshes of a pose; returns their indices.
Result<std::vector<uint32_t>> add_posed_meshes(const GltfDocument& document, const Pose& pose,
                                               std::span<const GltfWorldNode> nodes,
                                               NormalMaps normal_maps, GltfMeshes& meshes) {
    std::vector<glm::dmat4> joints;
    if (pose.skin != kNoIndex) {
        auto matrices = skin_matrices(document, pose.skin, nodes);
        if (!matrices) return matrices.error();
        joints = std::move(*matrices);
    }
    std::vector<uint32_t> indices;
    const GltfMesh& source = document.meshes[pose.mesh];
    for (size_t i = 0; i < source.primitives.size(); ++i) {
        if (!has_triangles(source.primitives[i])) continue;
        auto mesh = posed_primitive(document, source.primitives[i], normal_maps, pose, joints);
        if (!mesh) {
            const Error error = in_member(mesh.error().in(str_cat("primitive ", i)),
                                          str_cat(".primitives[", i, "]"));
            return in_element(error, "meshes", pose.mesh, source.name);
        }
        remove_flat_triangles(*mesh);
        if (mesh->indices.empty()) continue;
        indices.push_back(static_cast<uint32_t>(meshes.meshes.size()));
        meshes.meshes.push_back(std::move(*mesh));
        meshes.primitive_of.push_back(static_cast<uint32_t>(i));
    }
    return indices;
}

Status check_vertex_count(uint64_t count) {
    if (count <= kMaxPosedVertices) return Ok{};
    return Error{ErrorCode::Unsupported,
                 str_cat("morph targets and skins deform meshes of more than ", kMaxPosedVertices,
                         " vertices")};
}

uint64_t vertex_count(const GltfDocument& document, uint32_t mesh) {
    uint64_t count = 0;
    for (const GltfPrimitive& primitive : document.meshes[mesh].primitives) {
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) continue;
        count += document.accessors[position->second].count;
    }
    return count;
}

}  // namespace

Status pose_meshes(const GltfDocument& document, std::span<const GltfWorldNode> nodes,
                   NormalMaps normal_maps, GltfMeshes& meshes) {
    PosedMeshes known;
    uint64_t vertices = 0;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (node.mesh == kNoIndex || !placed.is_visible) continue;
        const uint32_t skin = is_skinned(document, node) ? node.skin : kNoIndex;
        const Pose pose{node.mesh, skin, morph_weights(document, placed.node)};
        if (pose.skin == kNoIndex && pose.weights.empty()) continue;
        auto found = known.find(pose);
        if (found == known.end()) {
            vertices += vertex_count(document, pose.mesh);
            if (auto status = check_vertex_count(vertices); !status) return status;
            auto added = add_posed_meshes(document, pose, nodes, normal_maps, meshes);
            if (!added) return in_element(added.error(), "nodes", placed.node, node.name);
            found = known.emplace(pose, std::move(*added)).first;
        }
        meshes.posed_meshes_of[placed.node] = found->second;
    }
    return Ok{};
}

}  // namespace tetralight::detail
