// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/batch_queries.h>

#include <algorithm>

#include <tetralight/base/compiler.h>
#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/closest_hull_point.h>
#include <tetralight/probes/detail/query_pass.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/detail/walk.h>
#include <tetralight/probes/detail/walk_one.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight::detail {
BatchQueries::BatchQueries(const ProbeVolumeView& volume, const Input& input,
                           const QueryKernels& kernels)
    : volume_(volume),
      input_(input),
      kernels_(kernels),
      has_tetrahedra_(detail::has_tetrahedra(volume)) {
    block_.world_origin = volume.info.world_origin;
}

bool BatchQueries::locate_block() {
    if (done_ >= input_.positions.size()) return false;
    load_positions();
    place();
    find_starts();
    begin_walks();
    walk();
    resolve_doubtful();
    apply_policy();
    write_hints();
    done_ += block_.count;
    return true;
}

void BatchQueries::load_positions() {
    block_.count = std::min(kBlockSize, input_.positions.size() - done_);
    const bool is_ordered = !input_.order.empty();
    for (size_t query = 0; query < block_.count; ++query) {
        const size_t next = done_ + query;
        source_[query] = static_cast<uint32_t>(is_ordered ? input_.order[next] : next);
    }
    const bool has_room = done_ + block_.count + kMostLanes <= input_.positions.size();
    if (!is_ordered && has_room) {
        block_.position = &input_.positions[done_];
        return;
    }
    for (size_t query = 0; query < block_.count; ++query) position_[query] = position_of(query);
    block_.position = position_.data();
}

/// Afterwards `block_.start` has the places of words in the seed grid.
void BatchQueries::place() {
    const std::span<const uint32_t> words = volume_.seed_grid;
    const bool has_grid = words.size() >= kSeedGridHeaderWords;
    kernels_.place_queries(has_grid ? seed_grid_header(words, 0) : SeedGridHeader{}, volume_.info,
                           block_);
    if (!has_tetrahedra_) block_.start.fill(kNoIndex);
    for (size_t query = 0; has_grid && query < block_.count; ++query) {
        prefetch(words.data() + block_.start[query]);
    }
}

/// Memory that may not be in a cache is prefetched by the loop before the one that reads it.
void BatchQueries::find_starts() {
    const std::span<const uint32_t> words = volume_.seed_grid;
    const auto cell_count = static_cast<uint32_t>(volume_.cells.size());
    const bool has_hints = !input_.hints.empty();
    for (size_t query = 0; query < block_.count; ++query) {
        uint32_t start = has_hints ? input_.hints[source_[query]] : kNoIndex;
        if (start >= cell_count) {
            const uint32_t word = block_.start[query];
            start = word < words.size() ? words[word] : kNoIndex;
            if (start >= cell_count) start = seed_of(query);
        }
        block_.start[query] = start;
        prefetch(volume_.cells.data() + start);
    }
}

/// The cell where a walk begins if no word of the outermost grid names it; 0 if there is none.
uint32_t BatchQueries::seed_of(size_t query) const {
    const uint32_t word = block_.start[query];
    uint32_t cell = 0;
    if (word < volume_.seed_grid.size()) {
        cell = seed_cell(volume_.seed_grid, word, glm::vec3(block_.local(query)));
    } else if (block_.course[query] != Course::NotFinite) {
        cell = start_cell(volume_, position_of(query));
    }
    return cell < volume_.cells.size() ? cell : 0;
}

void BatchQueries::begin_walks() {
    CellList& tetrahedra = block_.tetrahedra;
    for (auto* list : {&tetrahedra, &block_.precise, &block_.hull_cells, &block_.doubtful}) {
        list->count = 0;
    }
    for (size_t query = 0; query < block_.count; ++query) {
        const bool is_finite = block_.course[query] != Course::NotFinite;
        report_.not_finite_count += !is_finite;
        if (!has_tetrahedra_ && is_finite) block_.course[query] = Course::Alone;
        if (volume_.cells.empty()) block_.course[query] = Course::NotFinite;
    }
    fetch_corners();
    kernels_.begin_walks(volume_.info, block_);
}

void BatchQueries::fetch_corners() const {
    constexpr size_t kNearCache = 256 * 1024;  // bytes that are in a near cache anyway
    if (!has_tetrahedra_ || volume_.positions.size_bytes() <= kNearCache) return;
    for (size_t query = 0; query < block_.count; ++query) {
        for (const uint32_t probe : volume_.cells[block_.start[query]].vertices) {
            prefetch(volume_.positions.data() + probe);
        }
    }
}

void BatchQueries::walk() {
    for (uint32_t pass = 0; pass < input_.pass_limit; ++pass) {
        const size_t count =
            block_.tetrahedra.count + block_.precise.count + block_.hull_cells.count;
        if (count == 0) return;
        const size_t doubtful_before = block_.doubtful.count;
        run_pass(volume_, kernels_, block_);
        // `Walk` begins with the cells of doubtful queries.
        report_.step_count += count - (block_.doubtful.count - doubtful_before);
    }
    block_.give_up();
}

void BatchQueries::resolve_doubtful() {
    const CellList& list = block_.doubtful;
    for (size_t i = 0; i < list.count; ++i) {
        const uint32_t query = list.query[i], cell = list.cell[i];
        if (has_tetrahedra_ && input_.unresolved == Unresolved::KeepCell) {
            block_.location[query] = {cell};
            continue;
        }
        const LocationTrace trace = Walk(volume_, position_of(query)).run(cell);
        report_.step_count += trace.step_count;
        report_.fallback_count += trace.is_fallback;
        block_.location[query] = trace.location;
    }
}

void BatchQueries::apply_policy() {
    if (input_.outside.policy == OutsidePolicy::Extrapolate) return;
    for (size_t query = 0; query < block_.count; ++query) {
        CellLocation& location = block_.location[query];
        location = clamp_to_hull(volume_, position_of(query), location, input_.outside);
    }
}

void BatchQueries::write_hints() {
    if (input_.hints.empty()) return;
    for (size_t query = 0; query < block_.count; ++query) {
        input_.hints[source_[query]] = block_.location[query].cell;
    }
}

}  // namespace tetralight::detail
