// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_nodes.h>

#include <map>
#include <string>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Returns corrupt for a node.
Error node_error(const GltfDocument& document, uint32_t node, const std::string& message) {
    return in_element({ErrorCode::Corrupt, message}, "nodes", node, document.nodes[node].name);
}

Result<std::vector<uint32_t>> find_parents(const GltfDocument& document) {
    std::vector<uint32_t> parents(document.nodes.size(), kNoIndex);
    for (uint32_t node = 0; node < document.nodes.size(); ++node) {
        for (const uint32_t child : document.nodes[node].children) {
            if (parents[child] != kNoIndex) {
                return node_error(
                    document, child,
                    str_cat("has two parents, nodes ", parents[child], " and ", node));
            }
            parents[child] = node;
        }
    }
    return parents;
}

/// Precondition: each node has at most one parent. Then nodes that no root leads to form a cycle.
Status check_no_cycle(const GltfDocument& document, const std::vector<uint32_t>& parents) {
    std::vector<uint32_t> pending;
    for (uint32_t node = 0; node < parents.size(); ++node) {
        if (parents[node] == kNoIndex) pending.push_back(node);
    }
    std::vector<bool> is_reached(parents.size(), false);
    while (!pending.empty()) {
        const uint32_t node = pending.back();
        pending.pop_back();
        is_reached[node] = true;
        const auto& children = document.nodes[node].children;
        pending.insert(pending.end(), children.begin(), children.end());
    }
    for (uint32_t node = 0; node < parents.size(); ++node) {
        if (is_reached[node]) continue;
        return node_error(document, node, "is part of a cycle of nodes");
    }
    return Ok{};
}

Result<LightProbeUsage> usage_from(const std::string& word) {
    if (word == "off") return LightProbeUsage::Off;
    if (word == "blend") return LightProbeUsage::Blend;
    if (word == "proxy_volume") return LightProbeUsage::ProxyVolume;
    return Error{ErrorCode::InvalidArgument, ".extras.light_probes", quoted_value(word),
                 str_cat("extras.light_probes is \"", word,
                         "\", not \"off\", \"blend\" or \"proxy_volume\"")};
}

/// Reads what a node says of lightmaps into `use`, which has the values of its parent.
Status apply_lightmap_extras(const GltfNode& node, LightmapUse& use) {
    use.stitches_seams = node.stitches_seams.value_or(use.stitches_seams);
    if (node.receive_gi) {
        const std::string& word = *node.receive_gi;
        if (word != "lightmap" && word != "probes") {
            return Error{
                ErrorCode::InvalidArgument, ".extras.receive_gi", quoted_value(word),
                str_cat("extras.receive_gi is \"", word, "\", not \"lightmap\" or \"probes\"")};
        }
        use.receive_gi = word == "probes" ? ReceiveGi::Probes : ReceiveGi::Lightmap;
    }
    if (!node.lightmap_scale) return Ok{};
    use.scale = static_cast<float>(*node.lightmap_scale);
    if (use.scale >= 0.0f && use.scale <= 1e6f) return Ok{};
    return Error{ErrorCode::InvalidArgument, ".extras.lightmap_scale",
                 str_cat(*node.lightmap_scale),
                 str_cat("extras.lightmap_scale is ", *node.lightmap_scale,
                         ", not a number from 0 to 1000000")};
}

/// The roots of the scene; without a scene, all nodes that have no parent.
Result<std::vector<uint32_t>> find_roots(const GltfDocument& document,
                                         const std::vector<uint32_t>& parents) {
    std::vector<uint32_t> roots;
    if (!document.scene_roots) {
        for (uint32_t node = 0; node < parents.size(); ++node) {
            if (parents[node] == kNoIndex) roots.push_back(node);
        }
        return roots;
    }
    std::vector<bool> is_root(parents.size(), false);
    for (const uint32_t node : *document.scene_roots) {
        if (parents[node] != kNoIndex) {
            return node_error(
                document, node,
                str_cat("is a root of the scene and a child of node ", parents[node]));
        }
        if (is_root[node]) return node_error(document, node, "stands twice in the scene");
        is_root[node] = true;
    }
    return *document.scene_roots;
}

struct PendingNode {
    uint32_t node = 0;
    /// Index of the parent in the result; kNoIndex for roots.
    uint32_t parent_position = kNoIndex;
};

Result<GltfWorldNode> place_node(const GltfDocument& document, uint32_t node,
                                 const GltfWorldNode* parent) {
    const GltfNode& source = document.nodes[node];
    GltfWorldNode placed;
    placed.node = node;
    placed.world_from_node = source.parent_from_node;
    if (parent != nullptr) {
        placed.parent = parent->node;
        placed.world_from_node = parent->world_from_node * source.parent_from_node;
        placed.is_visible = parent->is_visible;
        placed.contributes_gi = parent->contributes_gi;
        placed.is_walkable = parent->is_walkable;
        placed.is_in_reflections = parent->is_in_reflections;
        placed.lightmap = parent->lightmap;
        placed.light_probes = parent->light_probes;
        placed.anchored_by = parent->anchored_by;
    }
    placed.is_visible = placed.is_visible && source.is_visible;
    placed.contributes_gi = source.contributes_gi.value_or(placed.contributes_gi);
    placed.is_walkable = source.is_walkable.value_or(placed.is_walkable);
    placed.is_in_reflections = source.is_in_reflections.value_or(placed.is_in_reflections);
    if (auto status = apply_lightmap_extras(source, placed.lightmap); !status) {
        return in_element(status.error(), "nodes", node, source.name);
    }
    if (source.probe_anchor) placed.anchored_by = node;
    if (source.light_probes) {
        const auto usage = usage_from(*source.light_probes);
        if (!usage) return in_element(usage.error(), "nodes", node, source.name);
        placed.light_probes = *usage;
    }
    if (is_finite_affine(source.parent_from_node) && is_finite_affine(placed.world_from_node)) {
        return placed;
    }
    if (source.rotation == glm::dquat(0.0, 0.0, 0.0, 0.0)) {
        return node_error(document, node, "rotation (0, 0, 0, 0) is a quaternion of length 0");
    }
    return node_error(document, node, "transform is not finite or not affine");
}

Result<std::vector<GltfWorldNode>> flatten_from(const GltfDocument& document,
                                                const std::vector<uint32_t>& roots) {
    std::vector<PendingNode> pending;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root});
    std::vector<GltfWorldNode> result;
    while (!pending.empty()) {
        const PendingNode next = pending.back();
        pending.pop_back();
        const bool is_root = next.parent_position == kNoIndex;
        const auto placed =
            place_node(document, next.node, is_root ? nullptr : &result[next.parent_position]);
        if (!placed) return placed.error();
        const auto position = static_cast<uint32_t>(result.size());
        result.push_back(*placed);
        const auto& children = document.nodes[next.node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            pending.push_back({*child, position});
        }
    }
    return result;
}

/// The index of the node of each name; kNoIndex if several nodes have the name.
std::map<std::string, uint32_t> unique_names(std::span<const SceneNode> nodes) {
    std::map<std::string, uint32_t> positions;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const bool is_first = positions.emplace(nodes[i].name, i).second;
        if (!is_first) positions[nodes[i].name] = kNoIndex;
    }
    return positions;
}

}  // namespace

Result<std::vector<GltfWorldNode>> flatten_nodes(const GltfDocument& document) {
    const auto parents = find_parents(document);
    if (!parents) return parents.error();
    const auto acyclic = check_no_cycle(document, *parents);
    if (!acyclic) return acyclic.error();
    const auto roots = find_roots(document, *parents);
    if (!roots) return roots.error();
    return flatten_from(document, *roots);
}

Result<std::vector<SceneNode>> scene_nodes(const GltfDocument& document,
                                           std::span<const GltfWorldNode> nodes) {
    std::vector<uint32_t> position_of(document.nodes.size(), kNoIndex);
    std::vector<SceneNode> result;
    for (const GltfWorldNode& placed : nodes) {
        position_of[placed.node] = static_cast<uint32_t>(result.size());
        const uint32_t parent = placed.parent == kNoIndex ? kNoIndex : position_of[placed.parent];
        result.push_back({document.nodes[placed.node].name, parent, placed.world_from_node,
                          placed.light_probes, kNoIndex});
    }
    const std::map<std::string, uint32_t> positions = unique_names(result);
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].anchored_by == kNoIndex) continue;
        const std::string& anchor = *document.nodes[nodes[i].anchored_by].probe_anchor;
        const auto found = positions.find(anchor);
        if (found == positions.end() || found->second == kNoIndex) {
            const uint32_t node = nodes[i].anchored_by;
            const bool is_unknown = found == positions.end();
            const Error error{
                is_unknown ? ErrorCode::NotFound : ErrorCode::InvalidArgument,
                ".extras.probe_anchor", quoted_value(anchor),
                str_cat("extras.probe_anchor is \"", anchor, "\", ",
                        is_unknown ? "which no node is called" : "which several nodes are called")};
            return in_element(error, "nodes", node, document.nodes[node].name);
        }
        result[i].probe_anchor = found->second;
    }
    return result;
}

}  // namespace tetralight::detail
