// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_probe_groups.h>

#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/bake/scene/detail/probe_group_check.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kPoints = 0;

/// Where the primitive's points are: at its indices, else at all positions.
Result<std::vector<glm::dvec3>> read_points(const GltfDocument& document,
                                            const GltfPrimitive& primitive) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return Error{"has no POSITION"};
    const auto positions = read_vec3s(document, position->second);
    if (!positions) return positions.error().in("POSITION");
    if (primitive.indices == kNoIndex) {
        return std::vector<glm::dvec3>(positions->begin(), positions->end());
    }
    const auto indices = read_indices(document, primitive.indices);
    if (!indices) return indices.error();
    std::vector<glm::dvec3> points;
    for (const uint32_t index : *indices) {
        if (index >= positions->size()) {
            return Error{
                str_cat("index ", index, " is out of range (", positions->size(), " vertices)")};
        }
        points.emplace_back((*positions)[index]);
    }
    return points;
}

/// The points of all POINTS primitives of a mesh; empty where it has none.
Result<std::vector<glm::dvec3>> read_mesh_points(const GltfDocument& document,
                                                 uint32_t mesh_index) {
    std::vector<glm::dvec3> all;
    if (mesh_index == kNoIndex) return all;
    const GltfMesh& mesh = document.meshes[mesh_index];
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
        if (mesh.primitives[i].mode != kPoints) continue;
        const auto points = read_points(document, mesh.primitives[i]);
        if (!points) {
            return points.error()
                .in(str_cat("primitive ", i))
                .in(gltf_place("mesh", mesh_index, mesh.name));
        }
        all.insert(all.end(), points->begin(), points->end());
    }
    return all;
}

/// Makes probes of a group node's children, those that are groups themselves left out.
std::vector<glm::dvec3> take_children(const GltfDocument& document, const GltfNode& node,
                                      std::vector<bool>& is_probe) {
    std::vector<glm::dvec3> positions;
    for (const uint32_t child : node.children) {
        if (document.nodes[child].is_probe_group) continue;
        positions.emplace_back(document.nodes[child].parent_from_node[3]);
        is_probe[child] = true;
    }
    return positions;
}

Result<ProbeGroup> read_group(const GltfDocument& document, const GltfWorldNode& placed,
                              std::vector<bool>& is_probe) {
    const GltfNode& node = document.nodes[placed.node];
    auto positions = read_mesh_points(document, node.mesh);
    if (!positions) return positions.error();
    if (positions->empty()) *positions = take_children(document, node, is_probe);
    return ProbeGroup{node.name, placed.world_from_node, std::move(*positions), node.dering};
}

}  // namespace

Result<GltfProbeGroups> read_gltf_probe_groups(const GltfDocument& document,
                                               std::span<const GltfWorldNode> nodes) {
    GltfProbeGroups result;
    result.is_probe.resize(document.nodes.size(), false);
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (!node.is_probe_group) continue;
        if (node.name.empty()) {
            return Error{str_cat("node ", placed.node, ": is a probe group and has no name")};
        }
        auto group = read_group(document, placed, result.is_probe);
        if (!group) return group.error().in(gltf_place("node", placed.node, node.name));
        result.groups.push_back(std::move(*group));
    }
    const auto status = check_probe_groups(result.groups);
    if (!status) return status.error();
    return result;
}

}  // namespace tetralight::detail
