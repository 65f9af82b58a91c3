// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/blend_probes.h>
#include <tetralight/probes/detail/hull_cell.h>
#include <tetralight/probes/detail/query_kernels.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/detail/write_answer.h>

namespace tetralight::detail {
namespace {

void test_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    size_t kept = 0;
    for (size_t i = 0; i < block.tetrahedra.count; ++i) kept = test_query(volume, block, i, kept);
    block.tetrahedra.count = kept;
}

void hull_weights(HullLanes& lanes) {
    const auto vector_at = [](const HullLanes::Vectors& from, size_t lane) {
        return glm::dvec3(from[0][lane], from[1][lane], from[2][lane]);
    };
    for (size_t lane = 0; lane < HullLanes::kCount; ++lane) {
        const HullTriangle triangle{vector_at(lanes.first, lane), vector_at(lanes.second, lane),
                                    vector_at(lanes.to_query, lane)};
        HullCellRays rays;
        for (size_t i = 0; i < 3; ++i) rays.rays[i] = glm::vec3(vector_at(lanes.rays[i], lane));
        const auto weights = hull_cell_weights(triangle, rays);
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

size_t test_query(const ProbeVolumeView& volume, QueryBlock& block, size_t from,
                  size_t kept) noexcept {
    auto& list = block.tetrahedra;
    const uint32_t query = list.query[from];
    const glm::dvec3 local(list.x[from], list.y[from], list.z[from]);
    const CellTest test = test_tetrahedron(volume, list.cell[from], local);
    if (test.verdict == Verdict::Inside) {
        block.location[query] = test.location;
    } else if (test.verdict == Verdict::Doubtful) {
        block.doubtful[block.doubtful_count] = query;
        block.doubtful_cell[block.doubtful_count++] = list.cell[from];
    } else if (test.next >= volume.info.inner_cell_count) {
        block.hull_cells.add(local, query, test.next);
    } else {
        list.move(from, kept);
        list.cell[kept++] = test.next;
    }
    return kept;
}

const QueryKernels& scalar_kernels() noexcept {
    static constexpr QueryKernels kKernels{test_tetrahedra, hull_weights, blend};
    return kKernels;
}

#ifndef TETRALIGHT_HAS_HIGHWAY
const QueryKernels& query_kernels() noexcept {
    return scalar_kernels();
}
#endif

}  // namespace tetralight::detail
