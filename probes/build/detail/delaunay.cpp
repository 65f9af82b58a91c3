// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/delaunay.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>

#include <tetralight/probes/build/detail/cell_sorter.h>
#include <tetralight/probes/build/detail/position_table.h>
#include <tetralight/probes/delaunay/delaunay_triangles.h>

namespace tetralight::detail {
namespace {

/// If memory is short, does what containers do: `operator new` throws, or what the program has set.
template <class T>
void require(const Result<T>& result) {
    if (!result) ::operator delete(::operator new(std::numeric_limits<ptrdiff_t>::max()));
}

/// What sorts the finite cells, ready to finish. `index_of(vertex)`: of its position.
template <class IndexOf>
CellSorter sorter_of(std::span<const DelaunayCell> cells, size_t position_count,
                     const IndexOf& index_of) {
    const auto first_vertex = [&](const DelaunayCell& cell) {
        const auto& [a, b, c, d] = cell.vertices;
        return std::min({index_of(a), index_of(b), index_of(c), index_of(d)});
    };
    CellSorter sorter(position_count);
    // The number of each cell among the finite ones, and kNoIndex for others.
    std::vector<uint32_t> numbers(cells.size(), kNoIndex);
    uint32_t finite_count = 0;
    size_t ghost_count = 0;
    for (size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].is_finite()) {
            numbers[i] = finite_count++;
            sorter.count(first_vertex(cells[i]));
        } else if (!cells[i].is_free()) {
            ++ghost_count;
        }
    }
    sorter.reserve_places(ghost_count);
    for (size_t i = 0; i < cells.size(); ++i) {
        const size_t ahead = i + CellSorter::kAhead;
        if (ahead < cells.size() && cells[ahead].is_finite()) {
            sorter.expect(first_vertex(cells[ahead]));
        }
        if (!cells[i].is_finite()) continue;
        std::array<uint64_t, 4> corners;
        for (size_t k = 0; k < 4; ++k) {
            corners[k] =
                make_corner(index_of(cells[i].vertices[k]), numbers[cells[i].neighbors[k] / 4]);
        }
        sorter.add(make_sorted_cell(corners, 4));
    }
    return sorter;
}

}  // namespace

std::vector<Cell> delaunay_tetrahedra(std::span<const glm::dvec3> positions) {
    DelaunayTetrahedra tetrahedra;
    {
        std::vector<uint32_t> vertices(positions.size());
        require(tetrahedra.insert(positions, vertices));
    }
    CellSorter sorter = [&] {
        const auto cells = tetrahedra.take_cells();
        // Vertices are numbered from 1 in the order of their positions.
        return sorter_of({cells.begin(), cells.size()}, positions.size(),
                         [](uint32_t vertex) { return vertex - 1; });
    }();
    return sorter.finish();
}

std::vector<Cell> delaunay_triangles(std::span<const glm::dvec2> positions) {
    DelaunayTriangles triangles;
    require(triangles.make(positions));
    const auto cells = triangles.cells();
    std::vector<uint32_t> numbers(cells.size(), kNoIndex);
    uint32_t count = 0;
    for (size_t i = 0; i < cells.size(); ++i) {
        if (!cells[i].is_ghost()) numbers[i] = count++;
    }
    std::vector<Cell> result;
    result.reserve(count);
    for (const DelaunayTriangle& triangle : cells) {
        if (triangle.is_ghost()) continue;
        Cell& cell = result.emplace_back();
        for (size_t i = 0; i < 3; ++i) {
            cell.vertices[i] = triangle.vertices[i];
            cell.neighbors[i] = numbers[triangle.neighbors[i] / 4];
        }
    }
    return result;
}

Status KeptTetrahedra::make_anew(std::span<const glm::dvec3> positions) {
    vertices_.resize(positions.size());
    positions_.assign(positions.begin(), positions.end());
    tetrahedra_.clear();
    return tetrahedra_.insert(positions, vertices_);
}

/// Changes the tetrahedra to other positions unless making them anew takes less time.
Status KeptTetrahedra::change(std::span<const glm::dvec3> wanted) {
    if (positions_.empty()) return make_anew(wanted);
    const PositionTable table(positions_);
    std::vector<uint32_t> found(wanted.size(), kNoIndex);
    std::vector<glm::dvec3> added;
    std::vector<uint32_t> places;
    for (uint32_t i = 0; i < wanted.size(); ++i) {
        const uint32_t old = table.find(wanted[i]);
        if (old != kNoIndex) {
            found[i] = std::exchange(vertices_[old], kNoIndex);
        } else {
            added.push_back(wanted[i]);
            places.push_back(i);
        }
    }
    std::vector<uint32_t> removed;
    std::ranges::copy_if(vertices_, std::back_inserter(removed),
                         [](uint32_t vertex) { return vertex != kNoIndex; });
    if (added.size() + removed.size() > wanted.size() / 2) return make_anew(wanted);
    if (auto status = tetrahedra_.remove(removed); !status) return status;
    std::vector<uint32_t> numbers(added.size());
    if (auto status = tetrahedra_.insert(added, numbers); !status) return status;
    for (size_t i = 0; i < places.size(); ++i) found[places[i]] = numbers[i];
    vertices_ = std::move(found);
    positions_.assign(wanted.begin(), wanted.end());
    return Ok{};
}

Result<std::vector<Cell>> KeptTetrahedra::change_to(std::span<const glm::dvec3> positions) {
    // What fails, or is left by an exception, keeps nothing.
    KeptTetrahedra changed = std::exchange(*this, KeptTetrahedra());
    if (auto status = changed.change(positions); !status) return status.error();
    *this = std::move(changed);
    if (tetrahedra_.cells().empty()) return std::vector<Cell>();
    std::vector<uint32_t> indices(tetrahedra_.last_vertex() + 1, kNoIndex);
    for (uint32_t i = 0; i < vertices_.size(); ++i) indices[vertices_[i]] = i;
    return sorter_of(tetrahedra_.cells(), positions.size(),
                     [&](uint32_t vertex) { return indices[vertex]; })
        .finish();
}

}  // namespace tetralight::detail
