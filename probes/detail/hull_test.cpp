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

}  // namespace

CellTest test_hull_cell(const ProbeVolumeView& volume, uint32_t cell,
                        const glm::dvec3& local) noexcept {
    std::array<glm::dvec3, 3> corners;
    HullCellRays rays;
    if (!find_hull_cell(volume, cell, corners, rays)) return {};
    const auto weights = hull_cell_weights(make_hull_triangle(corners, local), rays);
    return weights ? judge_hull_weights(volume, cell, *weights) : leave_cell(volume, cell, 3);
}

}  // namespace tetralight::detail
