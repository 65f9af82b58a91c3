// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/charts/detail/flat_triangle.h>

namespace tetralight::detail {

/// Triangles in a plane, none of which overlaps another. Grids of cells of twice the size each
/// hold them by their extent, so that a triangle lies in at most four cells.
class ChartLayout {
  public:
    /// Adds a triangle with positive area unless it overlaps one that is here. Returns true if it
    /// is added.
    bool try_add(const FlatTriangle& triangle);

    void clear();

  private:
    struct Cell {
        int64_t x = 0, y = 0;
        uint32_t level = 0;  ///< index into `levels_`

        bool operator==(const Cell&) const = default;
    };

    struct Slot {
        Cell cell;
        uint32_t first = 0;  ///< first entry of the cell, plus one; 0 if the slot is free
    };

    struct Entry {
        uint32_t triangle = 0;
        uint32_t next = 0;  ///< next entry of the cell, plus one; 0 at the end
    };

    struct Level {
        int exponent = 0;  ///< cells are 2^exponent wide
        std::vector<uint32_t> triangles;
    };

    struct CellRange {
        int64_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;

        [[nodiscard]] double count() const {
            return (static_cast<double>(max_x - min_x) + 1.0) *
                   (static_cast<double>(max_y - min_y) + 1.0);
        }
    };

    struct Bounds {
        glm::dvec2 min, max;
    };

    [[nodiscard]] static CellRange cells_of(const Bounds& bounds, int exponent);
    [[nodiscard]] bool overlaps_level(const FlatTriangle& triangle, const Bounds& bounds,
                                      uint32_t level) const;
    [[nodiscard]] bool overlaps_cell(const FlatTriangle& triangle, const Bounds& bounds,
                                     const Cell& cell) const;
    [[nodiscard]] bool overlaps_one(const FlatTriangle& triangle, const Bounds& bounds,
                                    uint32_t other) const;
    [[nodiscard]] uint32_t level_for(const Bounds& bounds);
    [[nodiscard]] size_t slot_of(const Cell& cell) const;
    void add_to_cell(const Cell& cell, uint32_t triangle);
    void grow_slots();

    std::vector<FlatTriangle> triangles_;
    std::vector<Bounds> bounds_;
    std::vector<Level> levels_;
    uint32_t level_count_ = 0;  ///< levels in use; the others keep their memory
    std::vector<Entry> entries_;
    std::vector<Slot> slots_;  ///< hash table of cells; a power of two
    std::vector<uint32_t> used_slots_;
};

}  // namespace tetralight::detail
