// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/hull_cells.h>

#include <algorithm>
#include <span>

namespace tetralight::detail {
namespace {

/// The corners of the face opposite a corner, seen from outside: counter-clockwise triangles; edges
/// with the inside on their left; single points.
std::span<const int> outward_face(Dimension dimension, int corner) {
    static constexpr int kEdges[3][2] = {{1, 2}, {2, 0}, {0, 1}};
    static constexpr int kEnds[2][1] = {{1}, {0}};
    if (dimension == Dimension::Space) return kOutwardFaces[corner];
    if (dimension == Dimension::Plane) return kEdges[corner];
    return kEnds[corner];
}

/// The hull cell over one face, knowing its inner cell only.
Cell hull_cell_over(const std::vector<Cell>& inner, uint32_t index, std::span<const int> face) {
    Cell cell;
    for (size_t i = 0; i < face.size(); ++i) cell.vertices[i] = inner[index].vertices[face[i]];
    const auto begin = cell.vertices.begin();
    if (face.size() == 3) std::rotate(begin, std::min_element(begin, begin + 3), begin + 3);
    cell.neighbors[3] = index;
    return cell;
}

std::vector<Cell> hull_cells(const std::vector<Cell>& inner, Dimension dimension) {
    std::vector<Cell> hull;
    if (dimension < Dimension::Line) return hull;
    for (uint32_t i = 0; i < inner.size(); ++i) {
        for (int corner = 0; corner < cell_vertex_count(dimension); ++corner) {
            if (inner[i].neighbors[corner] != kNoIndex) continue;
            hull.push_back(hull_cell_over(inner, i, outward_face(dimension, corner)));
        }
    }
    std::ranges::sort(hull, {}, &Cell::vertices);
    return hull;
}

/// What a hull cell has in common with its neighbor opposite a corner: two vertices, or in a plane
/// one. The same for both cells.
uint64_t shared_face(const Cell& cell, int corner, int face_size) {
    uint32_t low = kNoIndex, high = kNoIndex;
    for (int i = 0; i < face_size; ++i) {
        if (i == corner) continue;
        high = low;
        low = cell.vertices[i];
    }
    return uint64_t{std::max(low, high)} << 32 | std::min(low, high);
}

/// Links each hull cell with those beside it: two sides with the same face stand next to each other
/// once they are sorted by it.
void link_hull(std::span<Cell> hull, uint32_t first_index, int face_size) {
    if (face_size < 2) return;  // the two ends of a line touch nowhere

    struct Side {
        uint64_t face;
        uint32_t cell;
        int corner;
    };

    std::vector<Side> sides;
    sides.reserve(hull.size() * face_size);
    for (uint32_t i = 0; i < hull.size(); ++i) {
        for (int corner = 0; corner < face_size; ++corner) {
            sides.push_back({shared_face(hull[i], corner, face_size), i, corner});
        }
    }
    std::ranges::sort(sides, {}, &Side::face);
    for (size_t i = 0; i + 1 < sides.size(); i += 2) {
        const Side& a = sides[i];
        const Side& b = sides[i + 1];
        hull[a.cell].neighbors[a.corner] = first_index + b.cell;
        hull[b.cell].neighbors[b.corner] = first_index + a.cell;
    }
}

/// Links an inner cell with the hull cell across the face of the corner that they do not share.
void link_inner_cell(Cell& inner, const Cell& hull_cell, uint32_t hull_index, int face_size) {
    const auto first = hull_cell.vertices.begin();
    const auto last = first + face_size;
    for (int corner = 0; corner <= face_size; ++corner) {
        if (std::find(first, last, inner.vertices[corner]) == last) {
            inner.neighbors[corner] = hull_index;
        }
    }
}

}  // namespace

void add_hull_cells(std::vector<Cell>& cells, Dimension dimension) {
    std::vector<Cell> hull = hull_cells(cells, dimension);
    const int face_size = cell_vertex_count(dimension) - 1;
    const auto first_index = static_cast<uint32_t>(cells.size());
    link_hull(hull, first_index, face_size);
    for (uint32_t i = 0; i < hull.size(); ++i) {
        link_inner_cell(cells[hull[i].neighbors[3]], hull[i], first_index + i, face_size);
    }
    cells.insert(cells.end(), hull.begin(), hull.end());
}

}  // namespace tetralight::detail
