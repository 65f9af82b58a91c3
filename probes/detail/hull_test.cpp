// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/hull_test.h>

#include <tetralight/probes/detail/hull_cell.h>

namespace tetralight::detail {
namespace {

/// Corners and rays of a hull cell; false if an index is out of range.
bool find_hull_cell(const ProbeVolumeView& volume, uint32_t cell,
                    std::array<glm::dvec3, 3>& corners, HullCellRays& rays) {
    const uint32_t hull_index = cell - volume.info.inner_cell_count;
    if (cell < volume.info.inner_cell_count || hull_index >= volume.hull_rays.size()) return false;
    for (size_t i = 0; i < 3; ++i) {
        const uint32_t probe = volume.cells[cell].vertices[i];
        if (probe >= volume.positions.size()) return false;
        corners[i] = glm::dvec3(volume.positions[probe]);
    }
    rays = volume.hull_rays[hull_index];
    return true;
}

/// What follows from the weights. Without any the query is behind the hull triangle.
CellTest judge(const ProbeVolumeView& volume, uint32_t cell,
               const std::optional<glm::dvec3>& weights) {
    CellTest test;
    int face = 3;
    if (weights) {
        face = weights->x <= weights->y ? 0 : 1;
        if (weights->z < (*weights)[face]) face = 2;
        const double least = (*weights)[face];
        if (least >= 0.0) {
            test.verdict = Verdict::Inside;
            test.location = {cell, 0.0f, glm::vec4(glm::dvec4(*weights + 0.0, 0.0))};
            return test;
        }
        if (!(least < -kHullRounding)) return test;
    }
    test.next = volume.cells[cell].neighbors[static_cast<size_t>(face)];
    if (test.next < volume.cells.size()) test.verdict = Verdict::Outside;
    return test;
}

void load_lane(const HullTriangle& triangle, const HullCellRays& rays, HullLanes& lanes,
               size_t lane) {
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<int>(axis);
        lanes.first[axis][lane] = triangle.first[k];
        lanes.second[axis][lane] = triangle.second[k];
        lanes.to_query[axis][lane] = triangle.to_query[k];
        for (size_t i = 0; i < 3; ++i) {
            lanes.rays[i][axis][lane] = static_cast<double>(rays.rays[i][k]);
        }
    }
}

/// Moves a query on to what follows from its test.
void take(const ProbeVolumeView& volume, const CellTest& test, QueryBlock& block, size_t from,
          size_t& kept) {
    auto& list = block.hull_cells;
    const uint32_t query = list.query[from];
    if (test.verdict == Verdict::Inside) {
        block.location[query] = test.location;
    } else if (test.verdict == Verdict::Doubtful) {
        block.doubtful[block.doubtful_count] = query;
        block.doubtful_cell[block.doubtful_count++] = list.cell[from];
    } else if (test.next < volume.info.inner_cell_count) {
        block.tetrahedra.add({list.x[from], list.y[from], list.z[from]}, query, test.next);
    } else {
        list.move(from, kept);
        list.cell[kept++] = test.next;
    }
}

}  // namespace

CellTest test_hull_cell(const ProbeVolumeView& volume, uint32_t cell,
                        const glm::dvec3& local) noexcept {
    std::array<glm::dvec3, 3> corners;
    HullCellRays rays;
    if (!find_hull_cell(volume, cell, corners, rays)) return {};
    return judge(volume, cell, hull_cell_weights(make_hull_triangle(corners, local), rays));
}

void test_hull_cells(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block,
                     size_t count) noexcept {
    auto& list = block.hull_cells;
    HullLanes lanes;
    size_t kept = 0;
    for (size_t begin = 0; begin < count; begin += HullLanes::kCount) {
        const size_t size = std::min(HullLanes::kCount, count - begin);
        std::array<bool, HullLanes::kCount> is_good{};
        for (size_t lane = 0; lane < size; ++lane) {
            const size_t i = begin + lane;
            std::array<glm::dvec3, 3> corners;
            HullCellRays rays;
            is_good[lane] = find_hull_cell(volume, list.cell[i], corners, rays);
            const glm::dvec3 local(list.x[i], list.y[i], list.z[i]);
            if (is_good[lane]) load_lane(make_hull_triangle(corners, local), rays, lanes, lane);
        }
        kernels.hull_weights(lanes);
        for (size_t lane = 0; lane < size; ++lane) {
            const size_t i = begin + lane;
            const glm::dvec3 weights(lanes.weights[0][lane], lanes.weights[1][lane],
                                     lanes.weights[2][lane]);
            CellTest test;
            if (is_good[lane] && lanes.is_known[lane]) {
                test = judge(volume, list.cell[i], weights);
            } else if (is_good[lane]) {
                test = test_hull_cell(volume, list.cell[i], {list.x[i], list.y[i], list.z[i]});
            }
            take(volume, test, block, i, kept);
        }
    }
    while (count < list.count) list.move(count++, kept++);
    list.count = kept;
}

}  // namespace tetralight::detail
