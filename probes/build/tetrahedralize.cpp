// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/tetrahedralize.h>

#include <utility>

#include <tetralight/probes/build/detail/canonical_cells.h>
#include <tetralight/probes/build/detail/delaunay.h>
#include <tetralight/probes/build/detail/spread.h>

namespace tetralight {
namespace {

/// Segments between neighbors along the axis.
std::vector<Cell> line_segments(std::span<const glm::dvec3> positions, const glm::dvec3& axis) {
    const std::vector<uint32_t> order = detail::order_along(positions, axis);
    std::vector<Cell> cells;
    for (uint32_t i = 0; i + 1 < order.size(); ++i) {
        Cell cell;
        cell.vertices[0] = order[i];
        cell.vertices[1] = order[i + 1];
        cell.neighbors[0] = i + 2 < order.size() ? i + 1 : kNoIndex;
        cell.neighbors[1] = i > 0 ? i - 1 : kNoIndex;
        cells.push_back(cell);
    }
    return cells;
}

std::vector<Cell> inner_cells(std::span<const glm::dvec3> positions, const detail::Spread& spread) {
    switch (spread.dimension) {
        case Dimension::None:
            return {};
        case Dimension::Point:
            return {
                Cell{{0, kNoIndex, kNoIndex, kNoIndex}, {kNoIndex, kNoIndex, kNoIndex, kNoIndex}}};
        case Dimension::Line:
            return line_segments(positions, spread.line);
        case Dimension::Plane:
            return detail::delaunay_triangles(detail::project(positions, spread.normal));
        case Dimension::Space:
            return detail::delaunay_tetrahedra(positions);
    }
    return {};
}

}  // namespace

Tetrahedralization tetrahedralize(std::span<const glm::dvec3> positions, double flatness) {
    detail::Spread spread = detail::measure_spread(positions, flatness);
    std::vector<Cell> cells = inner_cells(positions, spread);
    while (cells.empty() && spread.dimension > Dimension::Point) {
        // Exact predicates found the set flatter than its measure in double.
        spread.dimension = static_cast<Dimension>(static_cast<uint32_t>(spread.dimension) - 1);
        cells = inner_cells(positions, spread);
    }
    auto result = spread.dimension == Dimension::Space
                      ? detail::with_hull_cells(std::move(cells), spread.dimension)
                      : detail::canonical_cells(std::move(cells), spread.dimension);
    result.axis = spread.axis();
    return result;
}

}  // namespace tetralight
