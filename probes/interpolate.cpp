// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/interpolate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/detail/batch_queries.h>
#include <tetralight/probes/detail/blend_probes.h>

namespace tetralight {
namespace {

template <class T>
std::span<T> elements(std::span<T> all, size_t begin, size_t count) {
    return all.empty() ? all : all.subspan(begin, count);
}

Status check_outputs(const InterpolationBatch& batch, size_t count) {
    const bool has_irradiance = !batch.irradiance.memory.empty();
    const bool has_occlusion = !batch.occlusion.memory.empty();
    if (count > 0 && !has_irradiance && !has_occlusion && batch.locations.empty()) {
        return Error{ErrorCode::InvalidArgument,
                     "none of irradiance, occlusion and locations has an output"};
    }
    if (!batch.locations.empty()) {
        const auto status = check_length("locations", batch.locations.size(), count);
        if (!status) return status;
    }
    if (has_irradiance) {
        const auto status = check_length("irradiance", batch.irradiance.capacity(), count);
        if (!status) return status;
        const ShFormat format = batch.irradiance.format;
        const auto strides = check_strides("irradiance", batch.irradiance, value_count(format),
                                           value_size(format), count);
        if (!strides) return strides;
    }
    if (!has_occlusion) return Ok{};
    const auto status = check_length("occlusion", batch.occlusion.capacity(), count);
    return status ? check_strides("occlusion", batch.occlusion, 4, sizeof(float), count) : status;
}

Status check_outside(const OutsideHull& outside) {
    if (outside.policy > OutsidePolicy::Ambient) {
        return Error{ErrorCode::InvalidArgument, "outside.policy",
                     str_cat(static_cast<uint32_t>(outside.policy)),
                     str_cat("outside has policy ", static_cast<uint32_t>(outside.policy))};
    }
    const bool is_length = std::isfinite(outside.fade_distance) && outside.fade_distance > 0.0f;
    if (outside.policy != OutsidePolicy::Ambient || is_length) return Ok{};
    return Error{
        ErrorCode::InvalidArgument, "outside.fade_distance", str_cat(outside.fade_distance),
        str_cat("fade_distance is ", outside.fade_distance, "; it must be positive and finite")};
}

}  // namespace

InterpolatedProbe interpolate(const ProbeVolumeView& volume, const CellLocation& location,
                              const Receiver& receiver) noexcept {
    return detail::blend_probes(volume, visible_location(volume, location, receiver));
}

Status check_receivers(const InterpolationBatch& batch) {
    const size_t count = batch.positions.size();
    const std::pair<const char*, size_t> lengths[] = {
        {"rendering_layers", batch.rendering_layers.size()},
        {"radii", batch.radii.size()},
        {"normals", batch.normals.size()}};
    for (const auto& [name, length] : lengths) {
        if (length == 0 || length >= count) continue;
        return Error{
            ErrorCode::InvalidArgument, name, str_cat(length),
            str_cat(name, " has ", length, " elements, but there are ", count, " positions")};
    }
    const auto is_length = [](float x) { return std::isfinite(x) && x >= 0.0f; };
    for (size_t i = 0; i < batch.radii.size(); ++i) {
        const float radius = batch.radii[i];
        if (is_length(radius)) continue;
        return Error{ErrorCode::InvalidArgument, str_cat("radii[", i, "]"), str_cat(radius),
                     str_cat("radius ", i, " is ", radius, "; it must be finite and not negative")};
    }
    if (is_length(batch.normal_offset)) return Ok{};
    return Error{
        ErrorCode::InvalidArgument, "normal_offset", str_cat(batch.normal_offset),
        str_cat("normal_offset is ", batch.normal_offset, "; it must be finite and not negative")};
}

InterpolationBatch part_of(const InterpolationBatch& batch, size_t begin, size_t count) noexcept {
    InterpolationBatch part = batch;
    part.positions = elements(batch.positions, begin, count);
    part.hints = elements(batch.hints, begin, count);
    part.sort_memory = elements(batch.sort_memory, 2 * begin, 2 * count);
    part.locations = elements(batch.locations, begin, count);
    part.rendering_layers = elements(batch.rendering_layers, begin, count);
    part.radii = elements(batch.radii, begin, count);
    part.normals = elements(batch.normals, begin, count);
    part.irradiance.memory = elements(batch.irradiance.memory,
                                      begin * batch.irradiance.answer_stride, std::dynamic_extent);
    part.occlusion.memory = elements(batch.occlusion.memory, begin * batch.occlusion.answer_stride,
                                     std::dynamic_extent);
    return part;
}

Status check_batch(const InterpolationBatch& batch) {
    const size_t count = batch.positions.size();
    if (!batch.hints.empty()) {
        const auto status = check_length("hints", batch.hints.size(), count);
        if (!status) return status;
    }
    if (!batch.sort_memory.empty()) {
        const auto status = check_length("sort_memory", batch.sort_memory.size() / 2, count);
        if (!status) return status;
    }
    if (auto status = check_outside(batch.outside); !status) return status;
    if (auto status = check_receivers(batch); !status) return status;
    return check_outputs(batch, count);
}

void detail::BatchTasks::run(size_t task) noexcept {
    const size_t begin = task * kBatchTaskSize;
    const size_t count = std::min(kBatchTaskSize, batch.positions.size() - begin);
    const BatchReport report = answer(volume, part_of(batch, begin, count));
    not_finite_count += report.not_finite_count;
    step_count += report.step_count;
    fallback_count += report.fallback_count;
}

Result<BatchReport> interpolate(const ProbeVolumeView& volume, const InterpolationBatch& batch) {
    if (auto status = check_batch(batch); !status) return status.error();
    return detail::answer(volume, batch);
}

void locate(const ProbeVolumeView& volume, std::span<const glm::vec3> positions,
            std::span<CellLocation> locations, const OutsideHull& outside) {
    TETRALIGHT_ASSERT(locations.size() >= positions.size(), "each position has a location");
    detail::BatchQueries queries(volume, {positions, {}, {}, outside}, detail::query_kernels());
    while (queries.locate_block()) {
        for (size_t i = 0; i < queries.source().size(); ++i) {
            locations[queries.source()[i]] = queries.locations()[i];
        }
    }
}

Status blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
             const ShOutput& irradiance, const OcclusionOutput& occlusion, Walls walls) {
    InterpolationBatch batch;
    batch.irradiance = irradiance;
    batch.occlusion = occlusion;
    if (auto status = check_outputs(batch, locations.size()); !status) return status;
    constexpr size_t kPart = 2048;
    std::array<uint32_t, kPart> answers;
    for (size_t begin = 0; begin < locations.size(); begin += kPart) {
        const size_t count = std::min(kPart, locations.size() - begin);
        std::iota(answers.begin(), answers.end(), static_cast<uint32_t>(begin));
        detail::query_kernels().blend(
            volume, locations.subspan(begin, count),
            {std::span(answers).first(count), irradiance, occlusion, walls});
    }
    return Ok{};
}

}  // namespace tetralight
