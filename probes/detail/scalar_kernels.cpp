// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/query_kernels.h>
#include <tetralight/probes/detail/query_pass.h>
#include <tetralight/probes/detail/query_place.h>
#include <tetralight/probes/detail/write_answer.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::detail {
namespace {

void place_queries(const SeedGridHeader& grid, const VolumeInfo& info, QueryBlock& block) {
    for (size_t query = 0; query < block.count; ++query) {
        const QueryPlace place = find_place(info, block.position[query]);
        const glm::vec3 local(place.local);
        block.tetrahedra.set_position(query, local);
        block.course[query] = place.course;
        const bool is_near = place.course >= Course::InDouble;
        block.start[query] = is_near ? static_cast<uint32_t>(seed_word(grid, 0, local)) : kNoIndex;
    }
}

void begin_walks(const VolumeInfo& info, QueryBlock& block) {
    for (uint32_t query = 0; query < block.count; ++query) begin_walk(info, block, query);
}

void test_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    size_t kept = 0;
    for (size_t i = 0; i < block.tetrahedra.count; ++i) kept = test_query(volume, block, i, kept);
    block.tetrahedra.count = kept;
}

/// No values: each query is tested alone.
void measure_cells(const ProbeVolumeView&, const QueryBlock&, const CellList&, size_t,
                   CellLanes& lanes) {
    lanes.is_known.fill(false);
}

void blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
           const BlendTarget& target) {
    const bool has_irradiance = !target.irradiance.memory.empty();
    const bool has_occlusion = !target.occlusion.memory.empty();
    for (size_t i = 0; i < locations.size(); ++i) {
        const InterpolatedProbe probe = interpolate(volume, locations[i], {target.walls});
        const size_t answer = target.answers[i];
        if (has_irradiance) {
            write_irradiance(target.irradiance, answer, &probe.irradiance.coefficients[0].x);
        }
        if (has_occlusion) write_values<4>(target.occlusion, answer, &probe.occlusion.x);
    }
}

}  // namespace

const QueryKernels& scalar_kernels() noexcept {
    static constexpr QueryKernels kKernels{place_queries, begin_walks,   test_tetrahedra,
                                           measure_cells, measure_cells, blend};
    return kKernels;
}

#ifndef TETRALIGHT_HAS_HIGHWAY
const QueryKernels& query_kernels() noexcept {
    return scalar_kernels();
}
#endif

}  // namespace tetralight::detail
