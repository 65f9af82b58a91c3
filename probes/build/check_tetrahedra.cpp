// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/check_tetrahedra.h>

#include <algorithm>
#include <array>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/canonical_cells.h>
#include <tetralight/probes/build/validate.h>

namespace tetralight {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// The face opposite a corner, counter-clockwise from outside, its smallest vertex first.
Triangle outward_face(const Cell& cell, int corner) {
    Triangle face;
    for (int i = 0; i < 3; ++i) face[i] = cell.vertices[kOutwardFaces[corner][i]];
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    return face;
}

/// True if `there` lies on the other side of the face opposite a corner of `here`.
bool is_across(const Cell& here, uint32_t here_index, int corner, const Cell& there) {
    const Triangle face = outward_face(here, corner);
    for (int i = 0; i < 4; ++i) {
        if (there.neighbors[i] != here_index) continue;
        if (outward_face(there, i) == Triangle{face[0], face[2], face[1]}) return true;
    }
    return false;
}

Status check_indices(const std::vector<Cell>& cells, size_t position_count) {
    for (size_t i = 0; i < cells.size(); ++i) {
        for (const uint32_t vertex : cells[i].vertices) {
            if (vertex < position_count) continue;
            return Error{ErrorCode::Corrupt, str_cat("tetrahedron ", i, ": vertex ", vertex,
                                                     " is out of range (", position_count, ")")};
        }
        for (const uint32_t neighbor : cells[i].neighbors) {
            if (neighbor < cells.size() || neighbor == kNoIndex) continue;
            return Error{ErrorCode::Corrupt, str_cat("tetrahedron ", i, ": neighbor ", neighbor,
                                                     " is out of range (", cells.size(), ")")};
        }
    }
    return Ok{};
}

Status check_neighbors(const std::vector<Cell>& cells) {
    for (uint32_t i = 0; i < cells.size(); ++i) {
        for (int corner = 0; corner < 4; ++corner) {
            const uint32_t neighbor = cells[i].neighbors[corner];
            if (neighbor == kNoIndex || is_across(cells[i], i, corner, cells[neighbor])) continue;
            return Error{ErrorCode::Corrupt,
                         str_cat("tetrahedra ", i, " and ", neighbor, " are not neighbors")};
        }
    }
    return Ok{};
}

Status check_all_used(const std::vector<Cell>& cells, size_t position_count) {
    std::vector<bool> is_used(position_count, false);
    for (const Cell& cell : cells) {
        for (const uint32_t vertex : cell.vertices) is_used[vertex] = true;
    }
    const auto count = std::ranges::count(is_used, false);
    if (count == 0) return Ok{};
    return Error{ErrorCode::Corrupt,
                 str_cat("left out ", count, " of ", position_count, " probes")};
}

/// True if the hull is one closed surface without a hole. If all its edges are convex too, it is a
/// convex polyhedron.
bool is_one_sphere(const Tetrahedralization& cells, size_t position_count) {
    const uint32_t first = cells.inner_cell_count;
    const auto count = static_cast<uint32_t>(cells.cells.size()) - first;
    std::vector<bool> is_reached(count, false);
    std::vector<bool> is_vertex(position_count, false);
    std::vector<uint32_t> open{first};
    is_reached[0] = true;
    uint32_t reached_count = 0;
    while (!open.empty()) {
        const uint32_t index = open.back();
        const Cell& cell = cells.cells[index];
        open.pop_back();
        ++reached_count;
        for (int i = 0; i < 3; ++i) {
            const uint32_t neighbor = cell.neighbors[i];
            if (neighbor == kNoIndex) return false;
            if (std::ranges::count(cells.cells[neighbor].neighbors, index) != 1) return false;
            is_vertex[cell.vertices[i]] = true;
            if (is_reached[neighbor - first]) continue;
            is_reached[neighbor - first] = true;
            open.push_back(neighbor);
        }
    }
    // Euler's formula, with 3/2 edges a triangle.
    const auto vertex_count = static_cast<uint32_t>(std::ranges::count(is_vertex, true));
    return reached_count == count && 2 * vertex_count == count + 4;
}

Status check_geometry(const Tetrahedralization& cells, std::span<const glm::dvec3> positions) {
    const std::vector<glm::vec3> rounded(positions.begin(), positions.end());
    ProbeVolumeView view;
    view.info.dimension = cells.dimension;
    view.info.inner_cell_count = cells.inner_cell_count;
    view.positions = rounded;
    view.exact_positions = positions;
    view.cells = cells.cells;
    ValidationReport report = validate(view);
    // Triangles that pair up bound what their tetrahedra fill: the sums differ by rounding alone.
    report.cell_measure = report.hull_measure;
    const std::vector<std::string> problems = report.problems();
    return problems.empty() ? Status(Ok{}) : Error{ErrorCode::Corrupt, problems[0]};
}

}  // namespace

Result<Tetrahedralization> check_tetrahedra(std::vector<Cell> tetrahedra,
                                            std::span<const glm::dvec3> positions) {
    if (auto status = check_indices(tetrahedra, positions.size()); !status) return status.error();
    if (auto status = check_neighbors(tetrahedra); !status) return status.error();
    if (auto status = check_all_used(tetrahedra, positions.size()); !status) return status.error();

    auto cells = detail::canonical_cells(std::move(tetrahedra), Dimension::Space);
    if (cells.cells.size() == cells.inner_cell_count || !is_one_sphere(cells, positions.size())) {
        return Error{ErrorCode::Corrupt, "the hull is not closed"};
    }
    if (auto status = check_geometry(cells, positions); !status) return status.error();
    return cells;
}

}  // namespace tetralight
