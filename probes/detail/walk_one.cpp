// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/walk_one.h>

#include <tetralight/probes/detail/hull_test.h>
#include <tetralight/probes/detail/query_place.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/detail/walk.h>

namespace tetralight::detail {
namespace {

CellTest test_cell(const ProbeVolumeView& volume, uint32_t cell, const QueryPlace& place) {
    if (cell >= volume.info.inner_cell_count) return test_hull_cell(volume, cell, place.local);
    if (place.course == Course::InFloat) {
        const CellTest test = test_tetrahedron(volume, cell, glm::vec3(place.local));
        if (test.verdict != Verdict::Doubtful) return test;
    }
    return test_tetrahedron(volume, cell, place.local);
}

}  // namespace

uint32_t start_cell(const ProbeVolumeView& volume, const glm::vec3& position) noexcept {
    return Walk(volume, position).start_cell();
}

LocationTrace walk_one(const ProbeVolumeView& volume, const glm::vec3& position,
                       uint32_t start) noexcept {
    uint32_t cell = start;
    uint32_t steps = 0;
    const QueryPlace place = find_place(volume.info, position);
    if (has_tetrahedra(volume) && place.course >= Course::InDouble) {
        for (CellTest test; steps < kPassLimit; cell = test.next) {
            ++steps;
            test = test_cell(volume, cell, place);
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
