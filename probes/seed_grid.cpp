// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/seed_grid.h>

#include <tetralight/base/contract.h>
#include <tetralight/probes/detail/batch_queries.h>

namespace tetralight {

void find_near_cells(const ProbeVolumeView& volume, std::span<const glm::vec3> positions,
                     std::span<uint32_t> cells) {
    TETRALIGHT_ASSERT(cells.size() >= positions.size(), "each position has a cell");
    detail::BatchQueries::Input input{positions, {}, {}, {}};
    input.pass_limit = 64;
    input.unresolved = detail::BatchQueries::Unresolved::KeepCell;
    detail::BatchQueries queries(volume, input, detail::query_kernels());
    while (queries.locate_block()) {
        for (size_t i = 0; i < queries.source().size(); ++i) {
            cells[queries.source()[i]] = queries.locations()[i].cell;
        }
    }
}

}  // namespace tetralight
