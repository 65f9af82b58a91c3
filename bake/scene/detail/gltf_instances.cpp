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
        if (is_finite_affine(transforms.back())) continue;
        return Error{ErrorCode::Corrupt, kAttributes, "",
                     str_cat("EXT_mesh_gpu_instancing: transform ", i, " is not finite")};
    }
    return transforms;
}

/// A mesh that a skin deforms is in the world.
Result<std::vector<GltfPlacement>> placements_of(const GltfDocument& document,
                                                 const GltfWorldNode& placed, bool is_in_world) {
    if (is_in_world) return std::vector<GltfPlacement>{{}};
    return mesh_placements(document, placed);
}

/// Adds the placements of a node that are not among those.
void add_flat_placements(const GltfDocument& document, const GltfWorldNode& placed,
                         std::span<const GltfPlacement> placements, PartList& parts) {
    ScenePart part;
    part.use = PartUse::Ignored;
    part.name = "meshes scaled to 0";
    part.note = "are left out: their transforms are not invertible";
    part.remedy = "if they are to be seen, give them a scale above 0 on every axis";
    part.changes_light = true;
    const GltfNode& node = document.nodes[placed.node];
    const std::string place = gltf_place("node", placed.node, node.name);
    const uint32_t count = transform_count(document, node);
    size_t next = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const bool is_placed = next < placements.size() && placements[next].transform == i;
        if (is_placed)
            ++next;
        else
            parts.add(part, node.instancing ? str_cat(place, " instance ", i) : place);
    }
}

}  // namespace

uint32_t transform_count(const GltfDocument& document, const GltfNode& node) {
    if (!node.instancing) return 1;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        const auto attribute = node.instancing->find(name);
        if (attribute == node.instancing->end()) continue;
        return static_cast<uint32_t>(document.accessors[attribute->second].count);
    }
    return 0;
}

Result<std::vector<GltfPlacement>> mesh_placements(const GltfDocument& document,
                                                   const GltfWorldNode& placed) {
    const auto transforms = read_transforms(document, placed);
    if (!transforms) return transforms.error();
    std::vector<GltfPlacement> placements;
    for (uint32_t i = 0; i < transforms->size(); ++i) {
        const glm::dmat4& world_from_mesh = (*transforms)[i];
        if (is_invertible(world_from_mesh)) placements.push_back({world_from_mesh, i});
    }
    return placements;
}

Result<std::vector<MeshInstance>> read_instances(const GltfDocument& document,
                                                 std::span<const GltfWorldNode> nodes,
                                                 const std::vector<bool>& is_probe,
                                                 const GltfMeshes& meshes, PartList& parts) {
    std::vector<MeshInstance> instances;
    for (uint32_t position = 0; position < nodes.size(); ++position) {
        const GltfWorldNode& placed = nodes[position];
        const GltfNode& node = document.nodes[placed.node];
        if (node.mesh == kNoIndex || is_probe[placed.node] || !placed.is_visible) continue;
        const bool is_posed = meshes.posed_meshes_of.contains(placed.node);
        const bool is_in_world = is_posed && is_skinned(document, node);
        const auto placements = placements_of(document, placed, is_in_world);
        if (!placements) {
            return in_element(placements.error(), "nodes", placed.node, node.name);
        }
        if (!is_in_world) add_flat_placements(document, placed, *placements, parts);
        LightmapUse lightmap = placed.lightmap;
        if (is_posed) lightmap.receive_gi = ReceiveGi::Probes;
        for (const auto& [world_from_mesh, transform] : *placements) {
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
