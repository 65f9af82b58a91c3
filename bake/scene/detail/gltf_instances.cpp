// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_instances.h>

#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/bake/scene/detail/gltf_skin.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Attributes of EXT_mesh_gpu_instancing, all of one length; absent ones have default values.
struct InstanceAttributes {
    std::vector<glm::vec3> translations;
    std::vector<glm::vec4> rotations;
    std::vector<glm::vec3> scales;
};

constexpr const char* kAttributes = ".extensions.EXT_mesh_gpu_instancing.attributes";

/// The number of instances. Returns corrupt if attributes have different lengths.
Result<size_t> instance_count(const GltfDocument& document, const GltfAttributes& attributes) {
    size_t count = 0;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        const auto attribute = attributes.find(name);
        if (attribute == attributes.end()) continue;
        const size_t own = document.accessors[attribute->second].count;
        if (count != 0 && own != count) {
            return Error{ErrorCode::Corrupt, str_cat(kAttributes, ".", name), "",
                         str_cat(name, " has ", own, " elements, another attribute has ", count)};
        }
        count = own;
    }
    if (count == 0) {
        return Error{ErrorCode::Corrupt, kAttributes, "",
                     "has neither TRANSLATION nor ROTATION nor SCALE"};
    }
    return count;
}

Status read_vec3_attribute(const GltfDocument& document, const GltfAttributes& attributes,
                           const char* name, std::vector<glm::vec3>& values) {
    const auto attribute = attributes.find(name);
    if (attribute == attributes.end()) return Ok{};
    auto result = read_vec3s(document, attribute->second);
    if (!result) return result.error().in(name);
    values = std::move(*result);
    return Ok{};
}

Result<InstanceAttributes> read_attributes(const GltfDocument& document,
                                           const GltfAttributes& attributes) {
    const auto count = instance_count(document, attributes);
    if (!count) return count.error();
    InstanceAttributes result;
    const auto translations =
        read_vec3_attribute(document, attributes, "TRANSLATION", result.translations);
    if (!translations) return translations.error();
    const auto scales = read_vec3_attribute(document, attributes, "SCALE", result.scales);
    if (!scales) return scales.error();
    if (const auto rotation = attributes.find("ROTATION"); rotation != attributes.end()) {
        auto rotations = read_vec4s(document, rotation->second);
        if (!rotations) return rotations.error().in("ROTATION");
        result.rotations = std::move(*rotations);
    }
    result.translations.resize(*count, glm::vec3(0.0f));
    result.rotations.resize(*count, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    result.scales.resize(*count, glm::vec3(1.0f));
    return result;
}

/// The transforms of a node's mesh: the node's own, or those of its instances.
Result<std::vector<glm::dmat4>> read_transforms(const GltfDocument& document,
                                                const GltfWorldNode& placed) {
    const auto& instancing = document.nodes[placed.node].instancing;
    if (!is_invertible(placed.world_from_node)) {
        return Error{ErrorCode::Corrupt, "transform is not invertible; its mesh would be flat"};
    }
    if (!instancing) return std::vector<glm::dmat4>{placed.world_from_node};
    const auto attributes = read_attributes(document, *instancing);
    if (!attributes) return attributes.error().in("EXT_mesh_gpu_instancing");
    std::vector<glm::dmat4> transforms;
    transforms.reserve(attributes->translations.size());
    for (size_t i = 0; i < attributes->translations.size(); ++i) {
        const glm::dvec4 q(attributes->rotations[i]);
        const glm::dmat4 node_from_instance =
            compose_transform(glm::dvec3(attributes->translations[i]),
                              glm::dquat(q.w, q.x, q.y, q.z), glm::dvec3(attributes->scales[i]));
        transforms.push_back(placed.world_from_node * node_from_instance);
        const bool is_finite = is_finite_affine(transforms.back());
        if (is_finite && is_invertible(transforms.back())) continue;
        return Error{ErrorCode::Corrupt, kAttributes, "",
                     str_cat("EXT_mesh_gpu_instancing: transform ", i, " is not ",
                             is_finite ? "invertible" : "finite")};
    }
    return transforms;
}

}  // namespace

Result<std::vector<MeshInstance>> read_instances(const GltfDocument& document,
                                                 std::span<const GltfWorldNode> nodes,
                                                 const std::vector<bool>& is_probe,
                                                 const GltfMeshes& meshes) {
    std::vector<MeshInstance> instances;
    for (uint32_t position = 0; position < nodes.size(); ++position) {
        const GltfWorldNode& placed = nodes[position];
        const GltfNode& node = document.nodes[placed.node];
        if (node.mesh == kNoIndex || is_probe[placed.node] || !placed.is_visible) continue;
        const bool is_posed = meshes.posed_meshes_of.contains(placed.node);
        const auto transforms = is_posed && is_skinned(document, node)
                                    ? std::vector<glm::dmat4>{glm::dmat4(1.0)}
                                    : read_transforms(document, placed);
        if (!transforms) {
            return in_element(transforms.error(), "nodes", placed.node, node.name);
        }
        LightmapUse lightmap = placed.lightmap;
        if (is_posed) lightmap.receive_gi = ReceiveGi::Probes;
        for (const glm::dmat4& world_from_mesh : *transforms) {
            for (const uint32_t mesh : meshes.meshes_of_node(document, placed.node)) {
                instances.push_back({mesh, world_from_mesh, node.name, placed.contributes_gi,
                                     position, placed.is_walkable, placed.is_in_reflections,
                                     lightmap});
            }
        }
    }
    return instances;
}

}  // namespace tetralight::detail
