// SPDX-License-Identifier: Apache-2.0
// Answers of a batch: locations, then the weights of what is lit, then light.
#include <algorithm>
#include <array>

#include <tetralight/probes/detail/batch_queries.h>
#include <tetralight/probes/morton_order.h>
#include <tetralight/probes/receiver.h>

namespace tetralight::detail {
namespace {

void add(BatchReport& sum, const BatchReport& part) {
    sum.not_finite_count += part.not_finite_count;
    sum.step_count += part.step_count;
    sum.fallback_count += part.fallback_count;
}

/// True if weights depend on more than the location and the walls, which kernels know.
bool has_receivers(const ProbeVolumeView& volume, const InterpolationBatch& batch) {
    const bool has_radii = !batch.radii.empty() && batch.walls == Walls::HideProbes &&
                           !volume.visibility_blocks.empty();
    return has_radii || (!batch.rendering_layers.empty() && !volume.rendering_layers.empty());
}

Receiver receiver_of(const InterpolationBatch& batch, size_t position) {
    Receiver receiver{batch.walls};
    if (!batch.rendering_layers.empty()) {
        receiver.rendering_layers = batch.rendering_layers[position];
    }
    if (!batch.radii.empty()) receiver.radius = batch.radii[position];
    return receiver;
}

void blend_for_receivers(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                         const BatchQueries& queries, const QueryKernels& kernels) {
    std::array<CellLocation, kBlockSize> visible;
    const size_t count = queries.locations().size();
    for (size_t i = 0; i < count; ++i) {
        visible[i] = visible_location(volume, queries.locations()[i],
                                      receiver_of(batch, queries.source()[i]));
    }
    kernels.blend(volume, std::span(visible).first(count),
                  {queries.source(), batch.irradiance, batch.occlusion, Walls::Ignore});
}

BatchReport answer_in_place(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                            const QueryKernels& kernels) {
    BatchQueries::Input input;
    input.positions = batch.positions;
    input.hints = batch.hints;
    input.outside = batch.outside;
    if (!batch.sort_memory.empty()) {
        input.order = morton_order(input.positions, batch.sort_memory);
    }
    BatchQueries queries(volume, input, kernels);
    const bool is_blended = !batch.irradiance.memory.empty() || !batch.occlusion.memory.empty();
    const bool is_plain = !has_receivers(volume, batch);
    while (queries.locate_block()) {
        for (size_t i = 0; !batch.locations.empty() && i < queries.source().size(); ++i) {
            batch.locations[queries.source()[i]] = queries.locations()[i];
        }
        if (!is_blended) continue;
        if (is_plain) {
            kernels.blend(volume, queries.locations(),
                          {queries.source(), batch.irradiance, batch.occlusion, batch.walls});
        } else {
            blend_for_receivers(volume, batch, queries, kernels);
        }
    }
    return queries.report();
}

/// Positions pushed off their surfaces, and the cells where they lie before.
struct PushedBlock {
    std::array<glm::vec3, kBlockSize> positions;
    std::array<uint32_t, kBlockSize> hints;
};

/// Precondition: at most `kBlockSize` positions.
BatchReport push(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                 const QueryKernels& kernels, PushedBlock& pushed) {
    const size_t count = batch.positions.size();
    pushed.hints.fill(kNoIndex);
    std::ranges::copy(batch.hints.first(std::min(count, batch.hints.size())), pushed.hints.begin());
    BatchQueries queries(volume, {batch.positions, std::span(pushed.hints).first(count), {}, {}},
                         kernels);
    while (queries.locate_block()) {
        for (size_t i = 0; i < queries.locations().size(); ++i) {
            pushed.positions[i] = push_off_surface(volume, batch.positions[i], batch.normals[i],
                                                   queries.locations()[i], batch.normal_offset);
        }
    }
    BatchReport report = queries.report();
    report.not_finite_count = 0;  // counted where they are answered
    return report;
}

BatchReport answer_off_surfaces(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                                const QueryKernels& kernels) {
    BatchReport report;
    PushedBlock pushed;
    for (size_t begin = 0; begin < batch.positions.size(); begin += kBlockSize) {
        const size_t count = std::min(kBlockSize, batch.positions.size() - begin);
        InterpolationBatch part = part_of(batch, begin, count);
        add(report, push(volume, part, kernels, pushed));
        part.positions = std::span(pushed.positions).first(count);
        part.sort_memory = {};
        const std::span<uint32_t> hints = part.hints;
        part.hints = std::span(pushed.hints).first(count);
        add(report, answer_in_place(volume, part, kernels));
        std::ranges::copy(part.hints.first(hints.size()), hints.begin());
    }
    return report;
}

}  // namespace

BatchReport answer(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                   const QueryKernels& kernels) {
    if (batch.normals.empty()) return answer_in_place(volume, batch, kernels);
    return answer_off_surfaces(volume, batch, kernels);
}

}  // namespace tetralight::detail
