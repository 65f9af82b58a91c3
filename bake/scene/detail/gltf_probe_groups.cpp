// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_probe_groups.h>

#include <cmath>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/bake/scene/detail/probe_group_check.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kPoints = 0;

/// Of all boxes of a scene, so that a small file cannot need any amount of memory.
constexpr size_t kMostBoxProbes = 10'000'000;

/// The positions of the primitive's points: those of its indices, or all.
Result<std::vector<glm::dvec3>> read_points(const GltfDocument& document,
                                            const GltfPrimitive& primitive) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        return Error{ErrorCode::Corrupt, ".attributes.POSITION", "", "has no POSITION"};
    }
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
                ErrorCode::Corrupt, ".indices", str_cat(index),
                str_cat("index ", index, " is out of range (", positions->size(), " vertices)")};
        }
        points.emplace_back((*positions)[index]);
    }
    return points;
}

/// The points of all POINTS primitives of a mesh; empty if it has none.
Result<std::vector<glm::dvec3>> read_mesh_points(const GltfDocument& document,
                                                 uint32_t mesh_index) {
    std::vector<glm::dvec3> all;
    if (mesh_index == kNoIndex) return all;
    const GltfMesh& mesh = document.meshes[mesh_index];
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
        if (mesh.primitives[i].mode != kPoints) continue;
        const auto points = read_points(document, mesh.primitives[i]);
        if (!points) {
            const Error error = in_member(points.error().in(str_cat("primitive ", i)),
                                          str_cat(".primitives[", i, "]"));
            return in_element(error, "meshes", mesh_index, mesh.name);
        }
        all.insert(all.end(), points->begin(), points->end());
    }
    return all;
}

/// The positions of a group node's children, which are marked as probes. Skips children that are
/// groups themselves.
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

/// The centres of the cells of a box from -1 to 1 along each axis, x first: the probes of a light
/// probe volume of Blender, whose box has that size. `left` is how many probes there may be.
Result<std::vector<glm::dvec3>> read_box(const glm::dvec3& resolution, size_t left) {
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double number = resolution[axis];
        count *= number;
        if (number >= 1.0 && number == std::floor(number)) continue;
        return Error{ErrorCode::InvalidArgument, ".extras.probe_resolution", str_cat(number),
                     str_cat("probe_resolution is not three integers above 0 (", number, ")")};
    }
    if (!(count <= static_cast<double>(left))) {
        return Error{
            ErrorCode::InvalidArgument, ".extras.probe_resolution", str_cat(count),
            str_cat("probe_resolution: ", resolution.x, " x ", resolution.y, " x ", resolution.z,
                    " probes are too many; the boxes of a scene may have ", kMostBoxProbes)};
    }
    std::vector<glm::dvec3> positions;
    positions.reserve(static_cast<size_t>(count));
    const glm::dvec3 cell = 2.0 / resolution;
    glm::dvec3 i(0.0);
    for (i.z = 0.0; i.z < resolution.z; ++i.z) {
        for (i.y = 0.0; i.y < resolution.y; ++i.y) {
            for (i.x = 0.0; i.x < resolution.x; ++i.x) positions.push_back((i + 0.5) * cell - 1.0);
        }
    }
    return positions;
}

/// What a warning says of a group without probes.
std::string empty_warning(const GltfDocument& document, const GltfWorldNode& placed) {
    const GltfNode& node = document.nodes[placed.node];
    std::string reason =
        "it has neither a mesh of points nor child nodes (Blender: export Loose "
        "Points; light probe volumes need extras.probe_resolution)";
    if (node.mesh != kNoIndex) {
        reason = str_cat(gltf_place("mesh", node.mesh, document.meshes[node.mesh].name),
                         " has no points, but triangles or lines; delete its edges and faces, or "
                         "give the node child nodes");
    }
    return str_cat(document.path, ": ", gltf_place("node", placed.node, node.name),
                   ": the group has no probes: ", reason);
}

/// Positions in the space of the node. `box_probes_left` is how many probes boxes may still have.
Result<std::vector<glm::dvec3>> read_positions(const GltfDocument& document, const GltfNode& node,
                                               std::vector<bool>& is_probe,
                                               size_t& box_probes_left) {
    if (node.probe_resolution) {
        auto box = read_box(*node.probe_resolution, box_probes_left);
        if (box) box_probes_left -= box->size();
        return box;
    }
    auto positions = read_mesh_points(document, node.mesh);
    if (positions && positions->empty()) *positions = take_children(document, node, is_probe);
    return positions;
}

Result<ProbeGroup> read_group(const GltfDocument& document, const GltfWorldNode& placed,
                              std::vector<bool>& is_probe, size_t& box_probes_left) {
    const GltfNode& node = document.nodes[placed.node];
    auto positions = read_positions(document, node, is_probe, box_probes_left);
    if (!positions) return positions.error();
    std::string warning = positions->empty() ? empty_warning(document, placed) : "";
    return ProbeGroup{node.name,
                      placed.world_from_node,
                      std::move(*positions),
                      node.dering,
                      node.rendering_layers.value_or(kAllRenderingLayers),
                      std::move(warning)};
}

}  // namespace

Result<GltfProbeGroups> read_gltf_probe_groups(const GltfDocument& document,
                                               std::span<const GltfWorldNode> nodes) {
    GltfProbeGroups result;
    result.is_probe.resize(document.nodes.size(), false);
    std::vector<uint32_t> group_nodes;
    size_t box_probes_left = kMostBoxProbes;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (!node.is_probe_group) continue;
        if (node.name.empty()) {
            const Error error{ErrorCode::Corrupt, ".name", "", "is a probe group and has no name"};
            return in_element(error, "nodes", placed.node, "");
        }
        auto group = read_group(document, placed, result.is_probe, box_probes_left);
        if (!group) return in_element(group.error(), "nodes", placed.node, node.name);
        result.groups.push_back(std::move(*group));
        group_nodes.push_back(placed.node);
    }
    const auto checked = check_probe_groups(result.groups);
    if (checked) return result;
    Error error = checked.error();
    error.field = str_cat("nodes[", group_nodes[probe_group_index(error.field).value_or(0)], "]");
    return error;
}

}  // namespace tetralight::detail
