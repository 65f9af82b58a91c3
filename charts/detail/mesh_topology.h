// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/charts/unwrap.h>

namespace tetralight::detail {

/// The triangles of a mesh, connected where their edges have equal positions.
struct MeshTopology {
    /// Edge number 3t + k of triangle t runs from its corner k to corner (k + 1) % 3.
    struct EdgeUse {
        uint32_t group_begin = 0;  ///< first of the edges between the same two points in `edges`
        uint32_t group_size = 0;   ///< 0 if both ends of the edge are one point
        uint32_t rank = 0;         ///< place in the group
    };

    std::vector<glm::dvec3> points;  ///< distinct positions, from the least corner of all
    std::vector<std::array<uint32_t, 3>> triangles;  ///< points of each triangle
    std::vector<glm::dvec3> normals;                 ///< unit length; zero without area
    std::vector<double> areas;                       ///< square metres; zero without normal
    std::vector<uint32_t> edges;                     ///< edges grouped by their two points
    std::vector<EdgeUse> edge_uses;                  ///< group of each edge

    [[nodiscard]] uint32_t triangle_count() const {
        return static_cast<uint32_t>(triangles.size());
    }

    [[nodiscard]] glm::dvec3 center(uint32_t triangle) const {
        const auto& [a, b, c] = triangles[triangle];
        return (points[a] + points[b] + points[c]) / 3.0;
    }

    /// Where more triangles meet in one edge, each has only so many of them as neighbors, so that
    /// the time to visit all neighbors grows linearly with the number of triangles.
    static constexpr uint32_t kMaxNeighborsOfEdge = 16;

    /// Calls visit(edge) for each edge of another triangle between the same points.
    template <class Visit>
    void for_each_neighbor_edge(uint32_t edge, Visit&& visit) const {
        const EdgeUse& use = edge_uses[edge];
        if (use.group_size == 0) return;
        const uint32_t count = std::min(use.group_size - 1, kMaxNeighborsOfEdge);
        for (uint32_t k = 1; k <= count; ++k) {
            const uint32_t other = edges[use.group_begin + (use.rank + k) % use.group_size];
            if (other / 3 != edge / 3) visit(other);
        }
    }

    /// Calls visit(triangle) for each neighbor over an edge; twice for one that shares two edges.
    template <class Visit>
    void for_each_neighbor(uint32_t triangle, Visit&& visit) const {
        for (uint32_t edge = 3 * triangle; edge < 3 * triangle + 3; ++edge) {
            for_each_neighbor_edge(edge, [&](uint32_t other) { visit(other / 3); });
        }
    }
};

[[nodiscard]] MeshTopology make_mesh_topology(const ChartMesh& mesh);

}  // namespace tetralight::detail
