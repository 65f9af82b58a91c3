// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/blend_probes.h>
#include <tetralight/probes/detail/hull_cell.h>
#include <tetralight/probes/detail/query_kernels.h>
#include <tetralight/probes/detail/walk.h>
#include <tetralight/probes/detail/write_answer.h>

namespace tetralight::detail {
namespace {

/// Corners of a tetrahedron relative to a query; false: an index is out of range.
bool find_tetrahedron(const ProbeVolumeView& volume, const Cell& cell, const glm::dvec3& position,
                      std::array<glm::dvec3, 4>& corners) {
    for (int i = 0; i < 4; ++i) {
        if (cell.vertices[i] >= volume.positions.size()) return false;
        corners[i] = glm::dvec3(volume.positions[cell.vertices[i]]) - position;
    }
    return true;
}

/// Walks one query from `cell`, which ends up as the last tetrahedron that was tested.
void walk_query(const ProbeVolumeView& volume, QueryBlock& block, size_t query, uint32_t start,
                uint32_t& cell) {
    const glm::dvec3 position(block.x[query], block.y[query], block.z[query]);
    std::array<glm::dvec3, 4> corners;
    const auto leave_open = [&](uint32_t at) {
        block.unresolved[block.unresolved_count] = static_cast<uint32_t>(query);
        block.unresolved_cell[block.unresolved_count++] = at;
    };
    if (start != kNoIndex) cell = start;
    uint32_t previous = kNoIndex;
    for (uint32_t steps = 0; steps < kWalkLimit; ++steps) {
        ++block.step_count;
        if (!find_tetrahedron(volume, volume.cells[cell], position, corners)) break;
        const CellWeights weights = tetrahedron_weights(corners);
        if (weights.inside_measure() >= 0.0) {
            block.location[query] = finish(cell, weights);
            return;
        }
        const uint32_t next = volume.cells[cell].neighbors[weights.most_negative()];
        if (next >= volume.info.inner_cell_count) return leave_open(next);
        if (next == previous) break;
        previous = cell;
        cell = next;
    }
    leave_open(cell);
}

void walk_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
        const size_t first = stream * QueryBlock::kStreamSize;
        for (size_t i = 0; i < block.count[stream]; ++i) {
            walk_query(volume, block, first + i,
                       block.start[QueryBlock::start_index(first + i, stream)], block.cell[stream]);
        }
    }
}

void hull_weights(HullLanes& lanes) {
    for (size_t lane = 0; lane < HullLanes::kCount; ++lane) {
        std::array<glm::dvec3, 3> corners;
        HullCellRays rays;
        for (size_t i = 0; i < 3; ++i) {
            const auto& corner = lanes.corners[i];
            const auto& ray = lanes.rays[i];
            corners[i] = {corner[0][lane], corner[1][lane], corner[2][lane]};
            rays.rays[i] = glm::vec3(glm::dvec3(ray[0][lane], ray[1][lane], ray[2][lane]));
        }
        const auto weights = hull_cell_weights(corners, rays);
        lanes.is_known[lane] = weights.has_value();
        for (int i = 0; weights && i < 3; ++i) {
            lanes.weights[static_cast<size_t>(i)][lane] = (*weights)[i];
        }
    }
}

void blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
           const BlendTarget& target) {
    const bool has_irradiance = !target.irradiance.memory.empty();
    const bool has_occlusion = !target.occlusion.memory.empty();
    for (size_t i = 0; i < locations.size(); ++i) {
        const InterpolatedProbe probe = blend_probes(volume, locations[i]);
        const size_t answer = target.answers[i];
        if (has_irradiance) {
            write_irradiance(target.irradiance, answer, &probe.irradiance.coefficients[0].x);
        }
        if (has_occlusion) write_values<4>(target.occlusion, answer, &probe.occlusion.x);
    }
}

}  // namespace

const QueryKernels& scalar_kernels() noexcept {
    static constexpr QueryKernels kKernels{walk_tetrahedra, hull_weights, blend};
    return kKernels;
}

#ifndef TETRALIGHT_HAS_HIGHWAY
const QueryKernels& query_kernels() noexcept {
    return scalar_kernels();
}
#endif

}  // namespace tetralight::detail
