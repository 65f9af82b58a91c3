// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_skin.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <utility>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Four joints of each vertex, and their weights.
struct JointSet {
    std::vector<glm::vec4> joints;
    std::vector<glm::vec4> weights;
};

Error attribute_error(const std::string& name, const std::string& value,
                      const std::string& message) {
    return {ErrorCode::Corrupt, str_cat(".attributes.", name), value, message};
}

Status read_joint_attribute(const GltfDocument& document, const GltfPrimitive& primitive,
                            const std::string& name, size_t vertex_count,
                            std::vector<glm::vec4>& values) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) {
        return attribute_error(name, "", str_cat("has no ", name, ", which its skin needs"));
    }
    auto read = read_vec4s(document, attribute->second);
    if (!read) return read.error().in(name);
    if (read->size() != vertex_count) {
        return attribute_error(
            name, "",
            str_cat(name, " has ", read->size(), " elements, POSITION has ", vertex_count));
    }
    values = std::move(*read);
    return Ok{};
}

Status check_joints(const JointSet& set, size_t set_index, size_t joint_count) {
    for (size_t i = 0; i < set.joints.size(); ++i) {
        for (int k = 0; k < 4; ++k) {
            const float joint = set.joints[i][k], weight = set.weights[i][k];
            if (weight < 0.0f) {
                return attribute_error(str_cat("WEIGHTS_", set_index), str_cat(weight),
                                       str_cat("WEIGHTS_", set_index, ": weight ", weight,
                                               " of vertex ", i, " is negative"));
            }
            const bool counts = weight > 0.0f || (set_index == 0 && k == 0);
            const bool is_joint = joint >= 0.0f && joint < static_cast<float>(joint_count) &&
                                  std::floor(joint) == joint;
            if (is_joint || !counts) continue;
            return attribute_error(str_cat("JOINTS_", set_index), str_cat(joint),
                                   str_cat("JOINTS_", set_index, ": joint ", joint, " of vertex ",
                                           i, " is out of range (", joint_count, " joints)"));
        }
    }
    return Ok{};
}

/// Reads JOINTS_0 with WEIGHTS_0, and JOINTS_1 with WEIGHTS_1 if there is one of the two.
Result<std::vector<JointSet>> read_joint_sets(const GltfDocument& document,
                                              const GltfPrimitive& primitive, size_t vertex_count,
                                              size_t joint_count) {
    std::vector<JointSet> sets;
    for (size_t i = 0; i < 2; ++i) {
        const std::string joints = str_cat("JOINTS_", i), weights = str_cat("WEIGHTS_", i);
        const auto& attributes = primitive.attributes;
        if (i > 0 && !attributes.contains(joints) && !attributes.contains(weights)) break;
        JointSet& set = sets.emplace_back();
        auto status = read_joint_attribute(document, primitive, joints, vertex_count, set.joints);
        if (!status) return status.error();
        status = read_joint_attribute(document, primitive, weights, vertex_count, set.weights);
        if (!status) return status.error();
        status = check_joints(set, i, joint_count);
        if (!status) return status.error();
    }
    return sets;
}

/// The mean of the transforms of a vertex's joints.
glm::dmat4 blended_matrix(std::span<const JointSet> sets, std::span<const glm::dmat4> matrices,
                          size_t vertex) {
    glm::dmat4 sum(0.0);
    double weight_sum = 0.0;
    for (const JointSet& set : sets) {
        for (int k = 0; k < 4; ++k) {
            const double weight = set.weights[vertex][k];
            if (weight == 0.0) continue;
            sum += weight * matrices[static_cast<size_t>(set.joints[vertex][k])];
            weight_sum += weight;
        }
    }
    if (weight_sum > 0.0) return sum / weight_sum;
    return matrices[static_cast<size_t>(sets[0].joints[vertex][0])];
}

/// The direction of a vector; `otherwise` if it has none.
glm::vec3 direction_or(const glm::dvec3& vector, const glm::vec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0.0 ? glm::vec3(vector / length) : otherwise;
}

/// The inverse transpose but for a positive factor. Flat transforms have it too.
glm::dmat3 normal_matrix(const glm::dmat3& axes, double determinant) {
    const glm::dmat3 cofactors(glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]),
                               glm::cross(axes[0], axes[1]));
    return determinant < 0.0 ? -cofactors : cofactors;
}

/// Transforms a vertex; returns true if that mirrors it.
bool transform_vertex(const glm::dmat4& world_from_mesh, size_t vertex, Mesh& mesh) {
    const glm::dmat3 axes(world_from_mesh);
    const double determinant = glm::determinant(axes);
    glm::vec3& position = mesh.positions[vertex];
    position = glm::vec3(world_from_mesh * glm::dvec4(glm::dvec3(position), 1.0));
    if (!mesh.normals.empty()) {
        glm::vec3& normal = mesh.normals[vertex];
        normal = direction_or(normal_matrix(axes, determinant) * glm::dvec3(normal), normal);
    }
    if (!mesh.tangents.empty()) {
        glm::vec4& tangent = mesh.tangents[vertex];
        const glm::vec3 old(tangent);
        tangent = glm::vec4(direction_or(axes * glm::dvec3(old), old),
                            determinant < 0.0 ? -tangent.w : tangent.w);
    }
    return determinant < 0.0;
}

Result<std::vector<glm::mat4>> read_bind_matrices(const GltfDocument& document,
                                                  const GltfSkin& skin) {
    if (skin.inverse_bind_matrices == kNoIndex) {
        return std::vector<glm::mat4>(skin.joints.size(), glm::mat4(1.0f));
    }
    auto matrices = read_mat4s(document, skin.inverse_bind_matrices);
    if (!matrices) return matrices.error().in("inverseBindMatrices");
    if (matrices->size() >= skin.joints.size()) return matrices;
    return Error{ErrorCode::Corrupt, ".inverseBindMatrices", str_cat(matrices->size()),
                 str_cat("inverseBindMatrices has ", matrices->size(), " matrices for ",
                         skin.joints.size(), " joints")};
}

}  // namespace

bool is_skinned(const GltfDocument& document, const GltfNode& node) {
    if (node.skin == kNoIndex || node.mesh == kNoIndex) return false;
    return std::ranges::any_of(document.meshes[node.mesh].primitives,
                               [](const GltfPrimitive& primitive) {
                                   return primitive.attributes.contains("JOINTS_0") ||
                                          primitive.attributes.contains("WEIGHTS_0");
                               });
}

Result<std::vector<glm::dmat4>> skin_matrices(const GltfDocument& document, uint32_t skin,
                                              std::span<const GltfWorldNode> nodes) {
    const GltfSkin& source = document.skins[skin];
    const auto bind_matrices = read_bind_matrices(document, source);
    if (!bind_matrices) return in_element(bind_matrices.error(), "skins", skin, source.name);
    std::vector<const GltfWorldNode*> placed(document.nodes.size(), nullptr);
    for (const GltfWorldNode& node : nodes) placed[node.node] = &node;
    std::vector<glm::dmat4> matrices;
    for (size_t i = 0; i < source.joints.size(); ++i) {
        const uint32_t joint = source.joints[i];
        if (placed[joint] == nullptr) {
            const std::string place = gltf_place("node", joint, document.nodes[joint].name);
            return in_element({ErrorCode::Corrupt, str_cat(".joints[", i, "]"), str_cat(joint),
                               str_cat("joint ", i, " (", place, ") is not in the scene")},
                              "skins", skin, source.name);
        }
        matrices.push_back(placed[joint]->world_from_node * glm::dmat4((*bind_matrices)[i]));
    }
    return matrices;
}

Status apply_skin(const GltfDocument& document, const GltfPrimitive& primitive,
                  std::span<const glm::dmat4> matrices, Mesh& mesh) {
    const size_t vertex_count = mesh.positions.size();
    const auto sets = read_joint_sets(document, primitive, vertex_count, matrices.size());
    if (!sets) return sets.error();
    size_t mirrored_count = 0;
    for (size_t i = 0; i < vertex_count; ++i) {
        if (transform_vertex(blended_matrix(*sets, matrices, i), i, mesh)) ++mirrored_count;
    }
    if (mirrored_count * 2 > vertex_count) {
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        }
    }
    return Ok{};
}

}  // namespace tetralight::detail
