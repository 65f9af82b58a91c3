// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/walk_one.h>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/hull_test.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/detail/walk.h>

namespace tetralight::detail {

uint32_t start_cell(const ProbeVolumeView& volume, const glm::vec3& position) noexcept {
    return Walk(volume, position).start_cell();
}

LocationTrace walk_one(const ProbeVolumeView& volume, const glm::vec3& position,
                       uint32_t start) noexcept {
    uint32_t cell = start;
    uint32_t steps = 0;
    const LocalPosition local = find_local(volume.info, position);
    if (has_tetrahedra(volume) && !local.is_moved) {
        for (CellTest test; steps < kPassLimit; cell = test.next) {
            ++steps;
            test = cell < volume.info.inner_cell_count
                       ? test_tetrahedron(volume, cell, local.position)
                       : test_hull_cell(volume, cell, local.position);
            if (test.verdict == Verdict::Inside) return {test.location, steps, false};
            if (test.verdict == Verdict::Doubtful) {
                --steps;  // `Walk` begins with this cell
                break;
            }
        }
    }
    LocationTrace trace = Walk(volume, position).run(cell);
    trace.step_count += steps;
    return trace;
}

}  // namespace tetralight::detail
