// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/delaunay/detail/growing_array.h>
#include <tetralight/probes/delaunay/detail/predicates.h>
#include <tetralight/probes/delaunay/memory_source.h>

namespace tetralight {

/// A tetrahedron of `DelaunayTetrahedra`, positively oriented: dot(b − a, cross(c − a, d − a)) > 0.
///
/// Behind each triangle of the hull is a cell whose last vertex is kGhost; its triangle a, b, c is
/// counter-clockwise seen from outside, as if the ghost were a point there.
struct DelaunayCell {
    static constexpr uint32_t kGhost = 0;
    static constexpr uint32_t kFree = 0xffff'ffffu;

    /// Vertices, from 1. The first is kFree if the cell is none.
    std::array<uint32_t, 4> vertices;
    /// 4 · cell + corner: the cell beyond the triangle opposite each vertex, and which of its
    /// corners is opposite that triangle.
    std::array<uint32_t, 4> neighbors;

    [[nodiscard]] bool is_free() const { return vertices[0] == kFree; }

    [[nodiscard]] bool is_ghost() const { return vertices[3] == kGhost; }

    /// True for a tetrahedron.
    [[nodiscard]] bool is_finite() const { return !is_free() && !is_ghost(); }
};

/// The Delaunay tetrahedra of a set of positions that grows and shrinks.
///
/// They depend on the positions alone, not on the order in which they came or on those that were
/// there before: positions on one sphere have one answer (detail::DelaunayPredicates).
///
/// Insertion is that of Bowyer and Watson (1981) with cells behind the hull, after a walk from the
/// cell before: fast where positions that follow each other are near each other, and those of the
/// first few thousand are all over the set (Amenta, Choi and Rote, "Incremental constructions con
/// BRIO", 2003). Positions are removed together: the hole that they leave is filled with those
/// tetrahedra of the positions around it that lie inside it.
class DelaunayTetrahedra {
  public:
    explicit DelaunayTetrahedra(const MemorySource& memory = {}) : memory_(memory) {}

    /// Adds positions, whose vertices get the numbers `vertices`, as many as there are positions:
    /// 1, 2, 3 and so on in an empty set. Precondition: finite, and distinct from each other and
    /// from those of the set. Returns out_of_resources if memory is short, or there would be more
    /// than 2^30 cells; the set is empty then.
    [[nodiscard]] Status insert(std::span<const glm::dvec3> positions,
                                std::span<uint32_t> vertices);

    /// Removes vertices. Precondition: distinct, and of the set. Errors as `insert`.
    [[nodiscard]] Status remove(std::span<const uint32_t> vertices);

    /// Finite cells, ghosts and free ones in no order; empty while all positions lie in one plane.
    [[nodiscard]] std::span<const DelaunayCell> cells() const;

    [[nodiscard]] const glm::dvec3& position(uint32_t vertex) const { return positions_[vertex]; }

    /// The largest number of a vertex.
    [[nodiscard]] uint32_t last_vertex() const;

    void clear();

    /// From now on, `changed_cells` are kept.
    void track_changes() { is_tracking_ = true; }

    /// Indices of cells that became others, became free, or have another neighbor, since the last
    /// `forget_changes`; some of them several times.
    [[nodiscard]] std::span<const uint32_t> changed_cells() const {
        return {changed_cells_.begin(), changed_cells_.size()};
    }

    /// True if all cells were made anew instead.
    [[nodiscard]] bool is_made_anew() const { return is_made_anew_; }

    void forget_changes();

    /// `cells`, alone: the set is empty then, and what it kept for changes is freed.
    [[nodiscard]] detail::GrowingArray<DelaunayCell> take_cells();

  private:
    /// A triangle around a cavity, and the cell that will stand on it.
    struct Facet {
        std::array<uint32_t, 4> vertices;
        uint32_t outside;  // as neighbors
        uint32_t corner;   // of the new vertex
        uint32_t cell;
    };

    /// A vertex of a cavity.
    struct LocalNumber {
        uint32_t round;
        uint32_t number;
    };

    /// Vertices of cavities whose triangles are linked by a table.
    static constexpr uint32_t kTableSize = 64;

    [[nodiscard]] bool add_positions(std::span<const glm::dvec3> positions,
                                     std::span<uint32_t> vertices);
    [[nodiscard]] bool find_first_cell(std::span<const uint32_t> vertices,
                                       std::array<uint32_t, 4>& corners) const;
    [[nodiscard]] bool begin(const std::array<uint32_t, 4>& corners);
    [[nodiscard]] bool insert_all(std::span<const uint32_t> vertices);
    [[nodiscard]] bool insert_vertex(uint32_t vertex);
    [[nodiscard]] bool remove_all(std::span<const uint32_t> vertices);
    [[nodiscard]] bool find_hole(std::span<const uint32_t> vertices);
    [[nodiscard]] bool find_rim(detail::GrowingArray<uint32_t>& rim);
    enum class Filled : uint8_t { Yes, No, OutOfMemory };
    [[nodiscard]] Filled fill_hole(const DelaunayTetrahedra& patch, std::span<const uint32_t> rim);
    [[nodiscard]] bool rebuild();
    [[nodiscard]] bool is_alive(uint32_t vertex) const;
    [[nodiscard]] int side(const DelaunayCell& cell, uint32_t corner,
                           const glm::dvec3& position) const;
    [[nodiscard]] uint32_t nearest_ghost(uint32_t ghost, const glm::dvec3& position) const;
    [[nodiscard]] uint32_t locate(const glm::dvec3& position) const;
    [[nodiscard]] bool is_in_conflict(uint32_t cell, const glm::dvec3& position) const;
    [[nodiscard]] bool find_cavity(uint32_t vertex, uint32_t first_cell);
    [[nodiscard]] bool fill_cavity();
    [[nodiscard]] bool number_vertices();
    void link_by_table();
    [[nodiscard]] bool link_by_sorting();
    void begin_round();
    [[nodiscard]] bool reserve_cells(size_t count);
    [[nodiscard]] bool reserve_changes(size_t count);
    void note_change(uint32_t cell);
    [[nodiscard]] uint32_t take_cell();

    MemorySource memory_;
    detail::DelaunayPredicates predicates_;
    detail::GrowingArray<glm::dvec3> positions_{memory_};  // by vertex; that of the ghost is unused
    detail::GrowingArray<DelaunayCell> cells_{memory_};
    /// For each cell: round + 1 if it is in the cavity of this round, round if it is known not to.
    detail::GrowingArray<uint32_t> marks_{memory_};
    detail::GrowingArray<LocalNumber> local_numbers_{memory_};  // by vertex
    detail::GrowingArray<uint32_t> changed_cells_{memory_};
    detail::GrowingArray<uint32_t> free_cells_{memory_}, free_vertices_{memory_};
    detail::GrowingArray<uint32_t> cavity_{memory_};
    detail::GrowingArray<Facet> facets_{memory_};
    detail::GrowingArray<std::array<uint32_t, 3>> sides_{memory_};
    std::array<uint32_t, kTableSize * kTableSize> table_{};
    bool is_tracking_ = false;
    bool is_made_anew_ = false;
    uint32_t round_ = 0;
    uint32_t last_cell_ = 0;
};

}  // namespace tetralight
