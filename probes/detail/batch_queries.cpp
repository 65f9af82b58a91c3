// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/batch_queries.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/closest_hull_point.h>
#include <tetralight/probes/detail/hull_walk.h>
#include <tetralight/probes/detail/walk.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/morton_order.h>

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
      stream_length_((input.positions.size() + QueryBlock::kStreamCount - 1) /
                     QueryBlock::kStreamCount) {
    block_.start.fill(kNoIndex);
}

bool BatchQueries::locate_block() {
    if (done_ >= stream_length_) return false;
    fill();
    walk();
    resolve_remaining();
    apply_policy();
    for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
        const size_t first = stream * QueryBlock::kStreamSize;
        for (size_t query = first; query < first + block_.count[stream]; ++query) {
            if (!input_.hints.empty()) {
                input_.hints[source_[query]] = block_.location[query].cell;
            }
        }
    }
    done_ += QueryBlock::kStreamSize;
    return true;
}

void BatchQueries::fill() {
    block_.unresolved_count = 0;
    for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
        const size_t begin = stream * stream_length_ + done_;
        const size_t end = std::min({(stream + 1) * stream_length_, input_.positions.size(),
                                     begin + QueryBlock::kStreamSize});
        block_.count[stream] = end > begin ? end - begin : 0;
        for (size_t i = 0; i < block_.count[stream]; ++i) {
            fill_query(stream * QueryBlock::kStreamSize + i, begin + i);
        }
        choose_starts(stream);
    }
    prefetch_starts();
}

void BatchQueries::fill_query(size_t query, size_t index) {
    if (!input_.order.empty()) index = static_cast<uint32_t>(input_.order[index]);
    source_[query] = static_cast<uint32_t>(index);
    const glm::vec3& position = input_.positions[index];
    if (!is_finite(position)) {
        // It walks along with the stream; what it finds is not used.
        not_finite_[not_finite_count_++] = static_cast<uint32_t>(query);
        block_.x[query] = block_.y[query] = block_.z[query] = 0.0;
        return;
    }
    const glm::dvec3 local = local_position(volume_.info, position);
    block_.x[query] = local.x;
    block_.y[query] = local.y;
    block_.z[query] = local.z;
}

/// A walk begins at its hint, else where the one before it ended, else, if that is many cells away,
/// at a seed.
void BatchQueries::choose_starts(size_t stream) {
    const size_t first = stream * QueryBlock::kStreamSize;
    const auto seed = [&](size_t query) {
        return start_near(Walk(volume_, input_.positions[source_[query]]).start_cell());
    };
    double reach = done_ == 0 ? -1.0 : square_reach(block_.cell[stream]);
    uint32_t* const starts = &block_.start[QueryBlock::start_index(0, stream)];
    starts[first + block_.count[stream]] = kNoIndex;
    for (size_t query = first; query < first + block_.count[stream]; ++query) {
        starts[query] = kNoIndex;
        const uint32_t hint = input_.hints.empty() ? kNoIndex : input_.hints[source_[query]];
        const glm::dvec3 position(block_.x[query], block_.y[query], block_.z[query]);
        const glm::dvec3 jump = position - std::exchange(last_[stream], position);
        if (hint < volume_.cells.size()) {
            starts[query] = start_near(hint);
        } else if (!input_.hints.empty() || glm::dot(jump, jump) > reach) {
            starts[query] = seed(query);
        }
        if (reach < 0.0) reach = square_reach(starts[query]);
    }
}

/// The squared distance beyond which a seed is nearer than this cell, in cells to be tested.
double BatchQueries::square_reach(uint32_t cell) const {
    constexpr double kReach = 3.0;  // edges of the cell, measured
    std::array<glm::dvec3, 4> corners{};
    if (!find_corners(volume_, cell, glm::dvec3(0.0), corners)) return 0.0;
    double square = 0.0;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 edge = corner - corners[0];
        square = std::max(square, glm::dot(edge, edge));
    }
    return kReach * kReach * square;
}

/// Starts that do not follow each other lie anywhere in memory: all are fetched at once.
void BatchQueries::prefetch_starts() const {
    const auto for_each_start = [&](const auto& visit) {
        for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
            const size_t first = stream * QueryBlock::kStreamSize;
            for (size_t query = first; query < first + block_.count[stream]; ++query) {
                const uint32_t start = block_.start[QueryBlock::start_index(query, stream)];
                if (start < volume_.cells.size()) visit(volume_.cells[start]);
            }
        }
    };
    for_each_start([](const Cell& cell) { __builtin_prefetch(&cell); });
    for_each_start([&](const Cell& cell) {
        for (const uint32_t probe : cell.vertices) {
            if (probe < volume_.positions.size()) __builtin_prefetch(&volume_.positions[probe]);
        }
    });
}

/// Walks of volumes that have tetrahedra begin in one of them.
uint32_t BatchQueries::start_near(uint32_t cell) const {
    if (!has_tetrahedra() || cell < volume_.info.inner_cell_count) return cell;
    const uint32_t inner = volume_.cells[cell].neighbors[3];
    return inner < volume_.info.inner_cell_count ? inner : kNoIndex;
}

bool BatchQueries::has_tetrahedra() const {
    return volume_.info.dimension == Dimension::Space && volume_.info.inner_cell_count > 0 &&
           volume_.info.inner_cell_count <= volume_.cells.size();
}

/// Kernels know tetrahedra; every query of a volume of lower dimension is left open.
void BatchQueries::walk() {
    if (has_tetrahedra()) {
        kernels_.walk_tetrahedra(volume_, block_);
        return walk_hull(volume_, kernels_, block_);
    }
    for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
        const size_t first = stream * QueryBlock::kStreamSize;
        for (size_t query = first; query < first + block_.count[stream]; ++query) {
            block_.unresolved[block_.unresolved_count] = static_cast<uint32_t>(query);
            block_.unresolved_cell[block_.unresolved_count++] =
                block_.start[QueryBlock::start_index(query, stream)];
        }
    }
}

void BatchQueries::resolve_remaining() {
    report_.step_count += std::exchange(block_.step_count, 0);
    uint32_t previous = kNoIndex;
    for (size_t i = 0; i < block_.unresolved_count; ++i) {
        const size_t query = block_.unresolved[i];
        const glm::vec3& position = input_.positions[source_[query]];
        const uint32_t start =
            block_.unresolved_cell[i] == kNoIndex ? previous : block_.unresolved_cell[i];
        const LocationTrace trace = trace_location(volume_, position, start);
        report_.step_count += trace.step_count;
        report_.fallback_count += trace.is_fallback;
        block_.location[query] = trace.location;
        previous = trace.location.cell;
    }
    for (size_t i = 0; i < not_finite_count_; ++i) block_.location[not_finite_[i]] = {};
    report_.not_finite_count += std::exchange(not_finite_count_, 0);
}

void BatchQueries::apply_policy() {
    if (input_.outside.policy == OutsidePolicy::Extrapolate) return;
    for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
        const size_t first = stream * QueryBlock::kStreamSize;
        for (size_t query = first; query < first + block_.count[stream]; ++query) {
            CellLocation& location = block_.location[query];
            location =
                clamp_to_hull(volume_, input_.positions[source_[query]], location, input_.outside);
        }
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
    while (queries.locate_block()) {
        for (size_t stream = 0; stream < QueryBlock::kStreamCount; ++stream) {
            const size_t first = stream * QueryBlock::kStreamSize;
            const size_t size = queries.block().count[stream];
            const std::span locations = std::span(queries.block().location).subspan(first, size);
            kernels.blend(volume, locations,
                          {queries.source().subspan(first, size), irradiance, occlusion});
        }
    }
    return queries.report();
}

}  // namespace tetralight::detail
