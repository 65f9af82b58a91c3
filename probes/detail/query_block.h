// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <tetralight/probes/locate.h>

namespace tetralight::detail {

/// Lanes of the widest vectors of floats: arrays have room for one vector behind their end.
inline constexpr size_t kMostLanes = 16;

/// Queries that are processed together, in passes: each pass tests one cell for every query that
/// is not located yet.
inline constexpr size_t kBlockSize = 512;

template <class T>
using BlockArray = std::array<T, kBlockSize + kMostLanes>;

/// Queries of a block, and for each the cell that it is tested in next.
struct CellList {
    alignas(64) BlockArray<uint32_t> query;
    alignas(64) BlockArray<uint32_t> cell;
    size_t count = 0;

    void add(uint32_t query_index, uint32_t cell_index) {
        query[count] = query_index;
        cell[count++] = cell_index;
    }
};

/// The same with local positions.
struct PositionList : CellList {
    alignas(64) BlockArray<float> x;
    alignas(64) BlockArray<float> y;
    alignas(64) BlockArray<float> z;
    /// Of vector code: the face where a query leaves its cell.
    alignas(64) BlockArray<uint32_t> face;

    void move(size_t from, size_t to) {
        query[to] = query[from];
        cell[to] = cell[from];
        x[to] = x[from];
        y[to] = y[from];
        z[to] = z[from];
    }

    void set_position(size_t place, const glm::vec3& local) {
        x[place] = local.x;
        y[place] = local.y;
        z[place] = local.z;
    }
};

/// How a query walks.
enum class Course : int32_t {
    NotFinite,  ///< not at all
    Alone,      ///< by the general code (`Walk`) from the beginning
    InDouble,   ///< its local position is not exactly a float
    InFloat,    ///< in double only where single precision does not decide
};

/// Vectors write behind the end of arrays.
struct QueryBlock {
    size_t count = 0;
    /// Positions of the queries, with room for a vector behind their end.
    const glm::vec3* position = nullptr;
    glm::dvec3 world_origin{0.0};

    // By query.
    alignas(64) BlockArray<Course> course;
    /// Place of the word in the seed grid, then the cell where the walk begins.
    alignas(64) BlockArray<uint32_t> start;
    BlockArray<CellLocation> location;

    /// Queries whose next cell is a tetrahedron, to be tested in single precision, or in double.
    PositionList tetrahedra;
    CellList precise;
    /// Queries whose next cell is a hull cell.
    CellList hull_cells;
    /// Queries for the general code, and the cell that they reached.
    CellList doubtful;

    /// Relative to the volume's origin.
    [[nodiscard]] glm::dvec3 local(size_t query) const {
        return glm::dvec3(position[query]) - world_origin;
    }

    /// Adds a query to the list for the test of `cell`; tetrahedra are those below `inner_count`.
    void add_cell(uint32_t query, uint32_t cell, uint32_t inner_count) {
        if (cell >= inner_count) return hull_cells.add(query, cell);
        if (course[query] == Course::InDouble) return precise.add(query, cell);
        tetrahedra.set_position(tetrahedra.count, glm::vec3(local(query)));
        tetrahedra.add(query, cell);
    }

    /// Leaves all queries that are not located to the general code.
    void give_up() {
        for (CellList* list : {static_cast<CellList*>(&tetrahedra), &precise, &hull_cells}) {
            for (size_t i = 0; i < list->count; ++i) doubtful.add(list->query[i], list->cell[i]);
            list->count = 0;
        }
    }
};

}  // namespace tetralight::detail
