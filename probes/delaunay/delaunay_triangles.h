// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/delaunay/detail/growing_array.h>
#include <tetralight/probes/delaunay/memory_source.h>

namespace tetralight {

/// A triangle of `DelaunayTriangles`, counter-clockwise. Beyond each edge of the hull is a cell
/// whose last vertex is kGhost.
struct DelaunayTriangle {
    static constexpr uint32_t kGhost = 0xffff'ffffu;

    std::array<uint32_t, 3> vertices;
    /// 4 · cell + corner: the cell beyond the edge opposite each vertex, and its corner opposite
    /// that edge.
    std::array<uint32_t, 3> neighbors;

    [[nodiscard]] bool is_ghost() const { return vertices[2] == kGhost; }
};

/// The Delaunay triangles of positions in a plane, made as `DelaunayTetrahedra` makes tetrahedra;
/// of positions on one circle, those that are greater by x, y are moved outwards far more than
/// others.
class DelaunayTriangles {
  public:
    explicit DelaunayTriangles(const MemorySource& memory = {}) : memory_(memory) {}

    /// Makes the triangles of positions, whose vertices have their numbers. Precondition: finite
    /// and distinct. Returns out_of_resources if memory is short; there are no triangles then.
    [[nodiscard]] Status make(std::span<const glm::dvec2> positions);

    /// Triangles and ghosts, in no order; empty if all positions lie on one line.
    [[nodiscard]] std::span<const DelaunayTriangle> cells() const {
        return {cells_.begin(), cells_.size()};
    }

  private:
    /// An edge around a cavity, from a to b with the cavity on its left.
    struct Edge {
        uint32_t a, b;
        uint32_t outside;  // as neighbors
        uint32_t cell;
    };

    [[nodiscard]] bool make_all();
    [[nodiscard]] bool find_first_cell(std::span<const uint32_t> order,
                                       std::array<uint32_t, 3>& corners) const;
    void begin(const std::array<uint32_t, 3>& corners);
    [[nodiscard]] int side(const DelaunayTriangle& cell, uint32_t corner,
                           const glm::dvec2& position) const;
    [[nodiscard]] uint32_t locate(const glm::dvec2& position) const;
    [[nodiscard]] bool is_in_conflict(uint32_t cell, const glm::dvec2& position) const;
    [[nodiscard]] bool insert_vertex(uint32_t vertex);
    void fill_cavity(uint32_t vertex);

    MemorySource memory_;
    std::span<const glm::dvec2> positions_;
    detail::GrowingArray<DelaunayTriangle> cells_{memory_};
    detail::GrowingArray<uint32_t> marks_{memory_};  // as in DelaunayTetrahedra
    detail::GrowingArray<uint32_t> cell_from_{
        memory_};  // by vertex, last the ghost's: the new cell on its edge
    detail::GrowingArray<uint32_t> cavity_{memory_};
    detail::GrowingArray<Edge> edges_{memory_};
    uint32_t round_ = 0;
    uint32_t last_cell_ = 0;
};

}  // namespace tetralight
