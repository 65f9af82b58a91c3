// SPDX-License-Identifier: Apache-2.0
#include "probes/build/detail/canonical_cells.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

namespace tetralight::detail {
namespace {

void swap_corners(Cell& cell, int a, int b) {
    std::swap(cell.vertices[a], cell.vertices[b]);
    std::swap(cell.neighbors[a], cell.neighbors[b]);
}

/// Sorts the vertices; an odd permutation is made even by swapping the last two, so that the cell
/// keeps its orientation. (A segment's is that of its axis: it is never odd.)
void sort_corners(Cell& cell, int count) {
    bool is_odd = false;
    for (int end = count; end > 1; --end) {
        for (int i = 1; i < end; ++i) {
            if (cell.vertices[i - 1] < cell.vertices[i]) continue;
            swap_corners(cell, i - 1, i);
            is_odd = !is_odd;
        }
    }
    if (is_odd) swap_corners(cell, count - 2, count - 1);
}

/// The order of cells by their vertices: a counting sort by the first one, then a comparison sort
/// of the few cells that share it.
std::vector<uint32_t> order_by_vertices(const std::vector<Cell>& cells) {
    uint32_t vertex_count = 0;
    for (const Cell& cell : cells) vertex_count = std::max(vertex_count, cell.vertices[0] + 1);
    std::vector<uint32_t> begins(size_t{vertex_count} + 1, 0);
    for (const Cell& cell : cells) ++begins[cell.vertices[0] + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());

    std::vector<uint32_t> order(cells.size());
    std::vector<uint32_t> next(begins.begin(), begins.end() - 1);
    for (uint32_t i = 0; i < cells.size(); ++i) order[next[cells[i].vertices[0]]++] = i;
    for (uint32_t v = 0; v < vertex_count; ++v) {
        std::sort(order.begin() + begins[v], order.begin() + begins[v + 1],
                  [&](uint32_t a, uint32_t b) { return cells[a].vertices < cells[b].vertices; });
    }
    return order;
}

/// Orders cells by their vertices and renames neighbors to match.
void sort_cells(std::vector<Cell>& cells) {
    const std::vector<uint32_t> order = order_by_vertices(cells);
    std::vector<uint32_t> place(cells.size());
    for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;

    std::vector<Cell> sorted;
    sorted.reserve(cells.size());
    for (const uint32_t i : order) {
        sorted.push_back(cells[i]);
        for (uint32_t& neighbor : sorted.back().neighbors) {
            if (neighbor != kNoIndex) neighbor = place[neighbor];
        }
    }
    cells = std::move(sorted);
}

/// The corners of the face opposite a corner, seen from outside: counter-clockwise triangles; edges
/// with the inside on their left; single points.
std::span<const int> outward_face(Dimension dimension, int corner) {
    static constexpr int kEdges[3][2] = {{1, 2}, {2, 0}, {0, 1}};
    static constexpr int kEnds[2][1] = {{1}, {0}};
    if (dimension == Dimension::Space) return kOutwardFaces[corner];
    if (dimension == Dimension::Plane) return kEdges[corner];
    return kEnds[corner];
}

/// Builds the hull around inner cells.
class HullBuilder {
  public:
    HullBuilder(std::vector<Cell>& inner, Dimension dimension)
        : inner_(inner), dimension_(dimension), face_size_(cell_vertex_count(dimension) - 1) {}

    std::vector<Cell> run() {
        if (dimension_ == Dimension::Point) return {};
        add_cells();
        link_neighbors();
        link_inner_cells();
        return std::move(hull_);
    }

  private:
    void add_cells() {
        for (uint32_t i = 0; i < inner_.size(); ++i) {
            for (int corner = 0; corner <= face_size_; ++corner) {
                if (inner_[i].neighbors[corner] == kNoIndex) hull_.push_back(cell_over(i, corner));
            }
        }
        std::ranges::sort(hull_, {}, &Cell::vertices);
    }

    /// A triangle begins with its smallest vertex.
    [[nodiscard]] Cell cell_over(uint32_t inner, int corner) const {
        const std::span<const int> corners = outward_face(dimension_, corner);
        Cell cell;
        for (size_t i = 0; i < corners.size(); ++i) {
            cell.vertices[i] = inner_[inner].vertices[corners[i]];
        }
        const auto begin = cell.vertices.begin();
        if (corners.size() == 3) {
            std::rotate(begin, std::min_element(begin, begin + 3), begin + 3);
        }
        cell.neighbors[3] = inner;
        return cell;
    }

    /// What hull cell `cell` has in common with its neighbor opposite `corner`, the same for both.
    [[nodiscard]] static uint64_t shared_face(const Cell& cell, int corner, int face_size) {
        uint64_t low = kNoIndex, high = kNoIndex;
        for (int i = 0; i < face_size; ++i) {
            if (i == corner) continue;
            high = low;
            low = cell.vertices[i];
        }
        return uint64_t{std::max(low, high)} << 32 | std::min(low, high);
    }

    void link_neighbors() {
        if (face_size_ < 2) return;  // the two ends of a line touch nowhere

        struct Side {
            uint32_t cell;
            int corner;
        };

        std::unordered_map<uint64_t, Side> open;
        for (uint32_t i = 0; i < hull_.size(); ++i) {
            for (int corner = 0; corner < face_size_; ++corner) {
                const uint64_t face = shared_face(hull_[i], corner, face_size_);
                const auto [other, is_first] = open.try_emplace(face, Side{i, corner});
                if (is_first) continue;
                hull_[i].neighbors[corner] = first_hull_index() + other->second.cell;
                hull_[other->second.cell].neighbors[other->second.corner] = first_hull_index() + i;
            }
        }
    }

    void link_inner_cells() {
        for (uint32_t i = 0; i < hull_.size(); ++i) {
            Cell& inner = inner_[hull_[i].neighbors[3]];
            for (int corner = 0; corner <= face_size_; ++corner) {
                const auto first = hull_[i].vertices.begin();
                const auto last = first + face_size_;
                if (std::find(first, last, inner.vertices[corner]) == last) {
                    inner.neighbors[corner] = first_hull_index() + i;
                }
            }
        }
    }

    [[nodiscard]] uint32_t first_hull_index() const { return static_cast<uint32_t>(inner_.size()); }

    std::vector<Cell>& inner_;
    std::vector<Cell> hull_;
    Dimension dimension_;
    int face_size_;
};

}  // namespace

Tetrahedralization canonical_cells(std::vector<Cell> cells, Dimension dimension) {
    for (Cell& cell : cells) sort_corners(cell, cell_vertex_count(dimension));
    sort_cells(cells);
    const std::vector<Cell> hull = HullBuilder(cells, dimension).run();
    const auto inner_count = static_cast<uint32_t>(cells.size());
    cells.insert(cells.end(), hull.begin(), hull.end());
    return {std::move(cells), inner_count, dimension, glm::dvec3(0.0)};
}

}  // namespace tetralight::detail
