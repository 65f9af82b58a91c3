// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_morph.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Adds the weighted differences of an attribute to `sums`, one for each vertex.
Status add_differences(const GltfDocument& document, const GltfPrimitive& primitive,
                       const char* name, std::span<const double> weights,
                       std::vector<glm::dvec3>& sums) {
    for (size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
        const auto attribute = primitive.targets[t].find(name);
        if (weights[t] == 0.0 || attribute == primitive.targets[t].end()) continue;
        const std::string place = str_cat("morph target ", t, ": ", name);
        const auto differences = read_vec3s(document, attribute->second);
        if (!differences) return differences.error().in(place);
        if (differences->size() != sums.size()) {
            return Error{ErrorCode::Corrupt, str_cat(".targets[", t, "].", name), "",
                         str_cat(place, " has ", differences->size(),
                                 " elements, the primitive has ", sums.size())};
        }
        for (size_t i = 0; i < sums.size(); ++i) {
            sums[i] += weights[t] * glm::dvec3((*differences)[i]);
        }
    }
    return Ok{};
}

glm::dvec3 normalized_or(const glm::dvec3& vector, const glm::dvec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : otherwise;
}

std::vector<glm::dvec3> as_doubles(const std::vector<glm::vec3>& vectors) {
    return {vectors.begin(), vectors.end()};
}

}  // namespace

std::vector<double> morph_weights(const GltfDocument& document, uint32_t node) {
    const GltfNode& source = document.nodes[node];
    const GltfMesh& mesh = document.meshes[source.mesh];
    std::vector<double> weights = source.weights.empty() ? mesh.weights : source.weights;
    size_t target_count = 0;
    for (const GltfPrimitive& primitive : mesh.primitives) {
        target_count = std::max(target_count, primitive.targets.size());
    }
    weights.resize(target_count, 0.0);
    const bool moves = std::ranges::any_of(weights, [](double weight) { return weight != 0.0; });
    return moves ? weights : std::vector<double>();
}

Status apply_morph_targets(const GltfDocument& document, const GltfPrimitive& primitive,
                           std::span<const double> weights, Mesh& mesh) {
    std::vector<glm::dvec3> positions = as_doubles(mesh.positions);
    auto status = add_differences(document, primitive, "POSITION", weights, positions);
    if (!status) return status;
    for (size_t i = 0; i < positions.size(); ++i) mesh.positions[i] = glm::vec3(positions[i]);
    if (!mesh.normals.empty()) {
        std::vector<glm::dvec3> normals = as_doubles(mesh.normals);
        status = add_differences(document, primitive, "NORMAL", weights, normals);
        if (!status) return status;
        for (size_t i = 0; i < normals.size(); ++i) {
            mesh.normals[i] = normalized_or(normals[i], mesh.normals[i]);
        }
    }
    if (mesh.tangents.empty()) return Ok{};
    std::vector<glm::dvec3> tangents(mesh.tangents.begin(), mesh.tangents.end());
    status = add_differences(document, primitive, "TANGENT", weights, tangents);
    if (!status) return status;
    for (size_t i = 0; i < tangents.size(); ++i) {
        const glm::vec4& old = mesh.tangents[i];
        mesh.tangents[i] = glm::vec4(normalized_or(tangents[i], glm::dvec3(old)), old.w);
    }
    return Ok{};
}

}  // namespace tetralight::detail
