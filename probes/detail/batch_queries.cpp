// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/batch_queries.h>

#include <algorithm>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/closest_hull_point.h>
#include <tetralight/probes/detail/hull_test.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/detail/walk.h>
#include <tetralight/probes/detail/walk_one.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/morton_order.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight::detail {
namespace {

template <class T>
std::span<T> part_of(std::span<T> elements, size_t begin, size_t count) {
    return elements.empty() ? elements : elements.subspan(begin, count);
}

}  // namespace

BatchQueries::BatchQueries(const ProbeVolumeView& volume, const Input& input,
                           const QueryKernels& kernels)
    : volume_(volume),
      input_(input),
      kernels_(kernels),
      has_tetrahedra_(detail::has_tetrahedra(volume)) {}

bool BatchQueries::locate_block() {
    if (done_ >= input_.positions.size()) return false;
    fill();
    find_words();
    find_starts();
    begin_walks();
    walk();
    resolve_doubtful();
    apply_policy();
    write_hints();
    done_ += count_;
    return true;
}

/// Positions that are not finite do not walk; those that were moved walk in double.
void BatchQueries::fill() {
    count_ = std::min(QueryBlock::kSize, input_.positions.size() - done_);
    walking_count_ = 0;
    block_.doubtful_count = 0;
    for (size_t query = 0; query < count_; ++query) {
        const size_t next = done_ + query;
        source_[query] = static_cast<uint32_t>(input_.order.empty() ? next : input_.order[next]);
        const glm::vec3& position = position_of(query);
        if (volume_.cells.empty() || !is_finite(position)) {
            block_.location[query] = {};
            report_.not_finite_count += !is_finite(position);
            continue;
        }
        const LocalPosition local = find_local(volume_.info, position);
        if (!has_tetrahedra_ || local.is_moved) {
            const uint32_t hint = hint_of(query);
            block_.doubtful[block_.doubtful_count] = static_cast<uint32_t>(query);
            block_.doubtful_cell[block_.doubtful_count++] =
                hint < volume_.cells.size() ? hint : start_cell(volume_, position);
            continue;
        }
        local_[walking_count_] = local.position;
        walking_[walking_count_++] = static_cast<uint32_t>(query);
    }
}

uint32_t BatchQueries::hint_of(size_t query) const {
    return input_.hints.empty() ? kNoIndex : input_.hints[source_[query]];
}

/// Each read of what may not be in a cache is a loop of its own that only fetches.
void BatchQueries::find_words() {
    const std::span<const uint32_t> words = volume_.seed_grid;
    const bool has_grid = words.size() >= kSeedGridHeaderWords;
    const SeedGridHeader grid = has_grid ? seed_grid_header(words, 0) : SeedGridHeader{};
    for (size_t i = 0; i < walking_count_; ++i) {
        word_[i] = has_grid ? seed_word(grid, 0, glm::vec3(local_[i])) : words.size();
        if (word_[i] < words.size()) __builtin_prefetch(&words[word_[i]]);
    }
}

void BatchQueries::find_starts() {
    const std::span<const uint32_t> words = volume_.seed_grid;
    for (size_t i = 0; i < walking_count_; ++i) {
        uint32_t start = hint_of(walking_[i]);
        if (start >= volume_.cells.size()) {
            if (words.empty()) {
                start = start_cell(volume_, position_of(walking_[i]));
            } else {
                start = seed_cell(words, word_[i], glm::vec3(local_[i]));
                if (start >= volume_.cells.size()) start = 0;
            }
        }
        start_[i] = start;
        __builtin_prefetch(&volume_.cells[start]);
    }
}

void BatchQueries::begin_walks() {
    block_.tetrahedra.count = 0;
    block_.hull_cells.count = 0;
    for (size_t i = 0; i < walking_count_; ++i) {
        auto& list =
            start_[i] < volume_.info.inner_cell_count ? block_.tetrahedra : block_.hull_cells;
        list.add(local_[i], walking_[i], start_[i]);
        for (const uint32_t probe : volume_.cells[start_[i]].vertices) {
            if (probe < volume_.positions.size()) __builtin_prefetch(&volume_.positions[probe]);
        }
    }
}

void BatchQueries::walk() {
    auto& [tetrahedra, hull_cells, doubtful, doubtful_cell, doubtful_count, location] = block_;
    for (uint32_t pass = 0; pass < input_.pass_limit; ++pass) {
        report_.step_count += tetrahedra.count + hull_cells.count;
        if (tetrahedra.count + hull_cells.count == 0) return;
        const size_t hull_count = hull_cells.count;
        const size_t doubtful_before = doubtful_count;
        if (tetrahedra.count > 0) kernels_.test_tetrahedra(volume_, block_);
        if (hull_count > 0) test_hull_cells(volume_, kernels_, block_, hull_count);
        report_.step_count -= doubtful_count - doubtful_before;  // `Walk` begins with these cells
    }
    for (const auto* list : {&tetrahedra, &hull_cells}) {
        for (size_t i = 0; i < list->count; ++i) {
            doubtful[doubtful_count] = list->query[i];
            doubtful_cell[doubtful_count++] = list->cell[i];
        }
    }
}

void BatchQueries::resolve_doubtful() {
    for (size_t i = 0; i < block_.doubtful_count; ++i) {
        const size_t query = block_.doubtful[i];
        if (has_tetrahedra_ && input_.unresolved == Unresolved::KeepCell) {
            block_.location[query] = {block_.doubtful_cell[i]};
            continue;
        }
        const LocationTrace trace = Walk(volume_, position_of(query)).run(block_.doubtful_cell[i]);
        report_.step_count += trace.step_count;
        report_.fallback_count += trace.is_fallback;
        block_.location[query] = trace.location;
    }
}

void BatchQueries::apply_policy() {
    if (input_.outside.policy == OutsidePolicy::Extrapolate) return;
    for (size_t query = 0; query < count_; ++query) {
        CellLocation& location = block_.location[query];
        location = clamp_to_hull(volume_, position_of(query), location, input_.outside);
    }
}

void BatchQueries::write_hints() {
    if (input_.hints.empty()) return;
    for (size_t query = 0; query < count_; ++query) {
        input_.hints[source_[query]] = block_.location[query].cell;
    }
}

BatchReport answer(const ProbeVolumeView& volume, const InterpolationBatch& batch, size_t begin,
                   size_t count, const QueryKernels& kernels) {
    BatchQueries::Input input;
    input.positions = batch.positions.subspan(begin, count);
    input.hints = part_of(batch.hints, begin, count);
    input.outside = batch.outside;
    if (!batch.sort_memory.empty()) {
        input.order = morton_order(input.positions, batch.sort_memory.subspan(2 * begin));
    }
    ShOutput irradiance = batch.irradiance;
    irradiance.memory =
        part_of(irradiance.memory, begin * irradiance.answer_stride, std::dynamic_extent);
    OcclusionOutput occlusion = batch.occlusion;
    occlusion.memory =
        part_of(occlusion.memory, begin * occlusion.answer_stride, std::dynamic_extent);

    BatchQueries queries(volume, input, kernels);
    const auto locations = part_of(batch.locations, begin, count);
    const bool is_blended = !irradiance.memory.empty() || !occlusion.memory.empty();
    while (queries.locate_block()) {
        for (size_t i = 0; !locations.empty() && i < queries.source().size(); ++i) {
            locations[queries.source()[i]] = queries.locations()[i];
        }
        if (!is_blended) continue;
        kernels.blend(volume, queries.locations(), {queries.source(), irradiance, occlusion});
    }
    return queries.report();
}

}  // namespace tetralight::detail
