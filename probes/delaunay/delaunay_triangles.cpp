// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/delaunay_triangles.h>

#include <algorithm>

#include <tetralight/probes/delaunay/detail/insertion_order.h>
#include <tetralight/probes/delaunay/detail/neighbor.h>
#include <tetralight/probes/delaunay/exact_signs.h>

namespace tetralight {
namespace {

using detail::cell_of;
using detail::corner_of;
using glm::dvec2;

constexpr uint32_t next(uint32_t corner) {
    return corner == 2 ? 0 : corner + 1;
}

bool is_before(const dvec2& a, const dvec2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/// 1 if d lies in the circumcircle of a counter-clockwise triangle, −1 if outside; as
/// DelaunayPredicates::in_sphere.
int in_circle(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d) {
    const int sign = exact_in_circle(a, b, c, d);
    if (sign != 0) return sign;
    const std::array<const dvec2*, 4> positions = {&a, &b, &c, &d};
    std::array<uint32_t, 4> order = {0, 1, 2, 3};
    std::sort(order.begin(), order.end(),
              [&](uint32_t i, uint32_t j) { return is_before(*positions[j], *positions[i]); });
    for (const uint32_t index : order) {
        if (index == 3) break;
        auto moved = positions;
        moved[index] = &d;
        const int side = exact_orientation(*moved[0], *moved[1], *moved[2]);
        if (side != 0) return side;
    }
    return -1;
}

}  // namespace

Status DelaunayTriangles::make(std::span<const dvec2> positions) {
    *this = DelaunayTriangles(memory_);
    positions_ = positions;
    if (make_all()) return Ok{};
    *this = DelaunayTriangles(memory_);
    return Error{ErrorCode::OutOfResources, "there is not enough memory for the triangles"};
}

bool DelaunayTriangles::make_all() {
    const size_t count = positions_.size();
    // Each vertex adds two cells.
    const size_t most = 2 * count + 4;
    detail::GrowingArray<uint32_t> order(memory_);
    if (!order.reserve(2 * count) || !cells_.reserve(most) || !marks_.reserve(most) ||
        !cavity_.reserve(most) || !edges_.reserve(most) || !cell_from_.reserve(count + 1)) {
        return false;
    }
    order.set_size(2 * count);
    cell_from_.set_size(count + 1);
    const std::span<uint32_t> ordered(order.begin(), count);
    for (uint32_t i = 0; i < count; ++i) ordered[i] = i;
    detail::order_by_rounds(ordered, {order.begin() + count, count});
    std::array<uint32_t, 3> corners{};
    if (!find_first_cell(ordered, corners)) return true;
    begin(corners);
    for (const uint32_t vertex : ordered) {
        if (std::ranges::find(corners, vertex) != corners.end()) continue;
        if (!insert_vertex(vertex)) return false;
    }
    return true;
}

/// The first three positions that do not lie on one line.
bool DelaunayTriangles::find_first_cell(std::span<const uint32_t> order,
                                        std::array<uint32_t, 3>& corners) const {
    if (order.size() < 3) return false;
    corners[0] = order[0];
    corners[1] = order[1];
    for (const uint32_t vertex : order.subspan(2)) {
        corners[2] = vertex;
        const int sign =
            exact_orientation(positions_[corners[0]], positions_[corners[1]], positions_[vertex]);
        if (sign < 0) std::swap(corners[0], corners[1]);
        if (sign != 0) return true;
    }
    return false;
}

/// The first triangle, with a ghost beyond each of its edges: ghost i + 1 beyond that of corner i.
void DelaunayTriangles::begin(const std::array<uint32_t, 3>& corners) {
    cells_.push_back({corners, {4 * 1 + 2, 4 * 2 + 2, 4 * 3 + 2}});
    for (uint32_t i = 0; i < 3; ++i) {
        // Its edge runs the other way. Ghosts share the edges from their vertices to the ghost.
        const uint32_t a = corners[next(next(i))], b = corners[next(i)];
        const uint32_t beyond_a = 1 + next(i), beyond_b = 1 + next(next(i));
        cells_.push_back({{a, b, DelaunayTriangle::kGhost}, {4 * beyond_b + 1, 4 * beyond_a, i}});
    }
    marks_.set_size(4);
    std::fill(marks_.begin(), marks_.end(), 0u);
}

/// On which side of the edge opposite a corner a position is: 1 on that of the corner.
int DelaunayTriangles::side(const DelaunayTriangle& cell, uint32_t corner,
                            const dvec2& position) const {
    return exact_orientation(positions_[cell.vertices[next(corner)]],
                             positions_[cell.vertices[next(next(corner))]], position);
}

uint32_t DelaunayTriangles::locate(const dvec2& position) const {
    uint32_t cell = last_cell_;
    if (cells_[cell].is_ghost()) cell = cell_of(cells_[cell].neighbors[2]);
    while (!cells_[cell].is_ghost()) {
        uint32_t corner = 0;
        while (corner < 3 && side(cells_[cell], corner, position) >= 0) ++corner;
        if (corner == 3) break;
        cell = cell_of(cells_[cell].neighbors[corner]);
    }
    return cell;
}

bool DelaunayTriangles::is_in_conflict(uint32_t cell, const dvec2& position) const {
    const DelaunayTriangle* tested = &cells_[cell];
    if (tested->is_ghost()) {
        const int sign = side(*tested, 2, position);
        if (sign != 0) return sign > 0;
        tested = &cells_[cell_of(tested->neighbors[2])];
    }
    const auto& [a, b, c] = tested->vertices;
    return in_circle(positions_[a], positions_[b], positions_[c], position) > 0;
}

bool DelaunayTriangles::insert_vertex(uint32_t vertex) {
    const dvec2& position = positions_[vertex];
    round_ += 2;
    cavity_.clear();
    edges_.clear();
    cavity_.push_back(locate(position));
    marks_[cavity_[0]] = round_ + 1;
    for (size_t i = 0; i < cavity_.size(); ++i) {
        const DelaunayTriangle& cell = cells_[cavity_[i]];
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const uint32_t neighbor = cell_of(cell.neighbors[corner]);
            if (marks_[neighbor] < round_) {
                const bool is_inside = is_in_conflict(neighbor, position);
                marks_[neighbor] = round_ + (is_inside ? 1 : 0);
                if (is_inside) cavity_.push_back(neighbor);
            }
            if (marks_[neighbor] > round_) continue;
            edges_.push_back({cell.vertices[next(corner)], cell.vertices[next(next(corner))],
                              cell.neighbors[corner], 0});
        }
    }
    fill_cavity(vertex);
    return true;
}

/// Replaces the cells of the cavity by one on each edge around it: two more than there were.
void DelaunayTriangles::fill_cavity(uint32_t vertex) {
    const auto from = [&](uint32_t a) -> uint32_t& {
        return cell_from_[a == DelaunayTriangle::kGhost ? positions_.size() : a];
    };
    for (size_t i = 0; i < edges_.size(); ++i) {
        Edge& edge = edges_[i];
        if (i < cavity_.size()) {
            edge.cell = cavity_[i];
        } else {
            edge.cell = static_cast<uint32_t>(cells_.size());
            cells_.set_size(cells_.size() + 1);
            marks_.push_back(0);
        }
        from(edge.a) = edge.cell;
    }
    // The corner of the new vertex: the ghost comes last.
    const auto corner_in = [&](const Edge& edge) -> uint32_t {
        if (edge.a == DelaunayTriangle::kGhost) return 1;
        return edge.b == DelaunayTriangle::kGhost ? 0 : 2;
    };
    for (const Edge& edge : edges_) {
        DelaunayTriangle& cell = cells_[edge.cell];
        const uint32_t corner = corner_in(edge);
        cell.vertices[corner] = vertex;
        cell.vertices[next(corner)] = edge.a;
        cell.vertices[next(next(corner))] = edge.b;
        cell.neighbors[corner] = edge.outside;
        cells_[cell_of(edge.outside)].neighbors[corner_of(edge.outside)] = 4 * edge.cell + corner;
        marks_[edge.cell] = 0;
        last_cell_ = edge.cell;
    }
    for (const Edge& edge : edges_) {
        // The cell on the edge that begins at b lies beyond the side of b and the vertex.
        const uint32_t other = from(edge.b);
        const auto& vertices = cells_[other].vertices;
        const auto new_corner =
            static_cast<uint32_t>(std::ranges::find(vertices, vertex) - vertices.begin());
        const uint32_t corner = corner_in(edge);
        cells_[edge.cell].neighbors[next(corner)] = 4 * other + next(next(new_corner));
        cells_[other].neighbors[next(next(new_corner))] = 4 * edge.cell + next(corner);
    }
}

}  // namespace tetralight
