// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/mesh_topology.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

#include <tetralight/base/contract.h>

namespace tetralight::detail {

namespace {

/// Indices of the positions in an order in which equal ones are neighbors.
std::vector<uint32_t> order_by_position(std::span<const glm::vec3> positions) {
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](uint32_t i) {
        const glm::vec3 p = positions[i];
        return std::tuple(p.x, p.y, p.z, i);
    });
    return order;
}

/// Fills `points` and returns the point of each position.
std::vector<uint32_t> weld(std::span<const glm::vec3> positions, std::vector<glm::dvec3>& points) {
    std::vector<uint32_t> point_of(positions.size());
    if (positions.empty()) return point_of;
    glm::vec3 least = positions[0];
    for (const glm::vec3 position : positions) least = glm::min(least, position);
    const glm::vec3* previous = nullptr;
    for (const uint32_t i : order_by_position(positions)) {
        if (!previous || *previous != positions[i]) {
            points.push_back(glm::dvec3(positions[i]) - glm::dvec3(least));
        }
        previous = &positions[i];
        point_of[i] = static_cast<uint32_t>(points.size() - 1);
    }
    return point_of;
}

/// A triangle whose height is below this share of its longest edge has no reliable normal.
constexpr double kLeastHeight = 1e-7;

void measure_triangle(MeshTopology& mesh, uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const glm::dvec3 ab = mesh.points[b] - mesh.points[a];
    const glm::dvec3 ac = mesh.points[c] - mesh.points[a];
    const glm::dvec3 bc = mesh.points[c] - mesh.points[b];
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double length = glm::length(normal);
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    if (!(length > kLeastHeight * longest)) return;
    mesh.normals[triangle] = normal / length;
    mesh.areas[triangle] = 0.5 * length;
}

struct EdgeEnds {
    uint32_t low, high, edge;

    auto operator<=>(const EdgeEnds&) const = default;
};

std::vector<EdgeEnds> sorted_edges(const MeshTopology& mesh) {
    std::vector<EdgeEnds> ends;
    ends.reserve(3 * mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t from = mesh.triangles[t][k];
            const uint32_t to = mesh.triangles[t][(k + 1) % 3];
            if (from != to) ends.push_back({std::min(from, to), std::max(from, to), 3 * t + k});
        }
    }
    std::ranges::sort(ends);
    return ends;
}

void group_edges(MeshTopology& mesh) {
    const std::vector<EdgeEnds> ends = sorted_edges(mesh);
    mesh.edge_uses.resize(3 * mesh.triangles.size());
    for (const EdgeEnds& end : ends) mesh.edges.push_back(end.edge);
    const auto count = static_cast<uint32_t>(ends.size());
    for (uint32_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && ends[end].low == ends[begin].low &&
               ends[end].high == ends[begin].high) {
            ++end;
        }
        for (uint32_t i = begin; i < end; ++i) {
            mesh.edge_uses[ends[i].edge] = {begin, end - begin, i - begin};
        }
    }
}

}  // namespace

MeshTopology make_mesh_topology(const ChartMesh& mesh) {
    TETRALIGHT_ASSERT(mesh.indices.size() % 3 == 0, "three indices a triangle");
    MeshTopology topology;
    const std::vector<uint32_t> point_of = weld(mesh.positions, topology.points);
    topology.triangles.resize(mesh.indices.size() / 3);
    topology.normals.resize(topology.triangles.size(), glm::dvec3(0.0));
    topology.areas.resize(topology.triangles.size());
    for (uint32_t t = 0; t < topology.triangle_count(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            TETRALIGHT_ASSERT(mesh.indices[3 * t + k] < point_of.size(), "index of a position");
            topology.triangles[t][k] = point_of[mesh.indices[3 * t + k]];
        }
        measure_triangle(topology, t);
    }
    group_edges(topology);
    return topology;
}

}  // namespace tetralight::detail
