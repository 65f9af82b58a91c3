// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/query_pass.h>

#include <algorithm>

#include <tetralight/probes/detail/hull_test.h>
#include <tetralight/probes/detail/tetrahedron_test.h>

namespace tetralight::detail {
namespace {

/// Moves a query to where its test in double says.
void take(const ProbeVolumeView& volume, QueryBlock& block, uint32_t query, uint32_t cell,
          const CellTest& test) {
    switch (test.verdict) {
        case Verdict::Inside:
            block.location[query] = test.location;
            break;
        case Verdict::Doubtful:
            block.doubtful.add(query, cell);
            break;
        case Verdict::Outside:
            block.add_cell(query, test.next, volume.info.inner_cell_count);
    }
}

/// Takes the queries out of a list. What is behind their end repeats the last one.
CellList take_all(CellList& list) {
    CellList taken;
    taken.count = list.count;
    if (list.count == 0) return taken;
    const size_t end = std::min(list.count + CellLanes::kCount - 1, list.query.size());
    for (size_t i = 0; i < end; ++i) {
        const size_t from = std::min(i, list.count - 1);
        taken.query[i] = list.query[from];
        taken.cell[i] = list.cell[from];
    }
    list.count = 0;
    return taken;
}

glm::dvec4 values_of(const CellLanes& lanes, size_t lane) {
    return {lanes.values[0][lane], lanes.values[1][lane], lanes.values[2][lane],
            lanes.values[3][lane]};
}

/// Tests the queries of a list in double: `measure` finds values in vectors, `judge(cell, values,
/// farthest)` says what follows from them, and `test(cell, local)` is for queries without values.
template <class Measure, class Judge, class Test>
void test_list(const ProbeVolumeView& volume, QueryBlock& block, const CellList& list,
               Measure measure, Judge judge, Test test) {
    CellLanes lanes;
    for (size_t i = 0; i < list.count; ++i) {
        const size_t lane = i % CellLanes::kCount;
        if (lane == 0) measure(volume, block, list, i, lanes);
        const uint32_t query = list.query[i], cell = list.cell[i];
        take(volume, block, query, cell,
             lanes.is_known[lane] ? judge(cell, values_of(lanes, lane), lanes.farthest[lane])
                                  : test(cell, block.local(query)));
    }
}

void test_precisely(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block) {
    test_list(
        volume, block, take_all(block.precise), kernels.measure_tetrahedra,
        [&](uint32_t cell, const glm::dvec4& volumes, double farthest) {
            return judge_volumes(volume, cell, volumes, farthest);
        },
        [&](uint32_t cell, const glm::dvec3& local) {
            return test_tetrahedron(volume, cell, local);
        });
}

void test_hull_cells(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block,
                     const CellList& list) {
    test_list(
        volume, block, list, kernels.measure_hull_cells,
        [&](uint32_t cell, const glm::dvec4& weights, double) {
            return judge_hull_weights(volume, cell, glm::dvec3(weights));
        },
        [&](uint32_t cell, const glm::dvec3& local) {
            return test_hull_cell(volume, cell, local);
        });
}

}  // namespace

void begin_walk(const VolumeInfo& info, QueryBlock& block, uint32_t query) noexcept {
    const uint32_t start = block.start[query];
    PositionList& list = block.tetrahedra;
    switch (block.course[query]) {
        case Course::NotFinite:
            block.location[query] = {};
            break;
        case Course::Alone:
            block.doubtful.add(query, start);
            break;
        case Course::InDouble:
            block.add_cell(query, start, info.inner_cell_count);
            break;
        case Course::InFloat:
            if (start >= info.inner_cell_count) return block.hull_cells.add(query, start);
            list.move(query, list.count);
            list.add(query, start);
    }
}

void run_pass(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block) {
    const CellList hull_cells = take_all(block.hull_cells);
    if (block.tetrahedra.count > 0) kernels.test_tetrahedra(volume, block);
    if (block.precise.count > 0) test_precisely(volume, kernels, block);
    test_hull_cells(volume, kernels, block, hull_cells);
}

size_t test_query(const ProbeVolumeView& volume, QueryBlock& block, size_t from,
                  size_t kept) noexcept {
    auto& list = block.tetrahedra;
    const uint32_t query = list.query[from], cell = list.cell[from];
    const glm::vec3 local(list.x[from], list.y[from], list.z[from]);
    const CellTest test = test_tetrahedron(volume, cell, local);
    if (test.verdict == Verdict::Inside) {
        block.location[query] = test.location;
    } else if (test.verdict == Verdict::Doubtful) {
        block.precise.add(query, cell);
    } else if (test.next >= volume.info.inner_cell_count) {
        block.hull_cells.add(query, test.next);
    } else {
        list.move(from, kept);
        list.cell[kept++] = test.next;
    }
    return kept;
}

}  // namespace tetralight::detail
