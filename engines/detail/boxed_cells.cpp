// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/boxed_cells.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/light_difference.h>
#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight::detail {
namespace {

using Face = std::array<uint32_t, 3>;
using Edge = std::array<uint32_t, 2>;

/// Around probes that are one point, metres.
constexpr float kPointMargin = 10.0f;

Box<glm::vec3> grown_box(std::span<const glm::vec3> positions) {
    glm::vec3 low = positions[0];
    glm::vec3 high = positions[0];
    for (const glm::vec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const glm::vec3 size = high - low;
    const float longest = std::max({size.x, size.y, size.z});
    const glm::vec3 margin(longest > 0.0f ? longest : kPointMargin);
    return {low - margin, high + margin};
}

/// The surface of the cells, counter-clockwise seen from outside. That of triangles in a plane has
/// each of them twice, once for each side.
std::vector<Face> surface(const ProbeVolumeView& volume) {
    std::vector<Face> faces;
    const uint32_t inner_count = volume.info.inner_cell_count;
    if (volume.info.dimension == Dimension::Plane) {
        for (const Cell& cell : volume.cells.first(inner_count)) {
            const auto& v = cell.vertices;
            faces.push_back({v[0], v[1], v[2]});
            faces.push_back({v[0], v[2], v[1]});
        }
        return faces;
    }
    for (const Cell& cell : volume.cells.subspan(inner_count)) {
        faces.push_back({cell.vertices[0], cell.vertices[1], cell.vertices[2]});
    }
    return faces;
}

/// Adds a corner outside of the surface: a tetrahedron on each face that it sees. What was there
/// before stays, other than in a Delaunay tetrahedralization with the corners.
void add_corner(uint32_t corner, BoxedCells& cells, std::vector<Face>& faces) {
    const auto point = [&](uint32_t vertex) { return glm::dvec3(cells.positions[vertex]); };
    std::vector<Face> next;
    std::vector<Edge> edges;
    for (const Face& face : faces) {
        const glm::dvec3 origin = point(face[0]);
        const glm::dvec3 normal = glm::cross(point(face[1]) - origin, point(face[2]) - origin);
        const glm::dvec3 to_corner = point(corner) - origin;
        // Beyond rounding: flat tetrahedra are of no use.
        constexpr double kFlat = 1e-12;
        if (glm::dot(normal, to_corner) <= kFlat * glm::length(normal) * glm::length(to_corner)) {
            next.push_back(face);
            continue;
        }
        cells.tetrahedra.push_back({face[0], face[1], face[2], corner});
        for (size_t i = 0; i < 3; ++i) edges.push_back({face[i], face[(i + 1) % 3]});
    }
    std::ranges::sort(edges);
    for (const Edge& edge : edges) {
        const bool is_between = std::ranges::binary_search(edges, Edge{edge[1], edge[0]});
        if (!is_between) next.push_back({edge[0], edge[1], corner});
    }
    faces = std::move(next);
}

/// Delaunay tetrahedra of all positions. The segments of a line are edges of them: the sphere
/// around a segment holds no other position.
void tetrahedralize_all(BoxedCells& cells) {
    const std::vector<glm::dvec3> positions(cells.positions.begin(), cells.positions.end());
    const Tetrahedralization all = tetrahedralize(positions);
    for (uint32_t i = 0; i < all.inner_cell_count; ++i) {
        cells.tetrahedra.push_back(all.cells[i].vertices);
    }
}

}  // namespace

BoxedCells boxed_cells(const ProbeVolumeView& volume) {
    BoxedCells cells;
    cells.box = grown_box(volume.positions);
    cells.positions.assign(volume.positions.begin(), volume.positions.end());
    cells.light = probe_light(volume);
    for (int i = 0; i < 8; ++i) {
        const glm::bvec3 is_high((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
        const glm::vec3 corner = glm::mix(cells.box.min, cells.box.max, is_high);
        cells.positions.push_back(corner);
        cells.light.push_back(
            light_at(volume, volume.info.world_origin + glm::dvec3(corner), Walls::HideProbes));
    }
    if (volume.info.dimension < Dimension::Plane) {
        tetrahedralize_all(cells);
        return cells;
    }
    if (volume.info.dimension == Dimension::Space) {
        for (const Cell& cell : volume.cells.first(volume.info.inner_cell_count)) {
            cells.tetrahedra.push_back(cell.vertices);
        }
    }
    std::vector<Face> faces = surface(volume);
    const uint32_t probe_count = volume.probe_count();
    for (uint32_t i = 0; i < 8; ++i) add_corner(probe_count + i, cells, faces);
    return cells;
}

}  // namespace tetralight::detail
