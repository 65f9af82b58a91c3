// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/pack_instances.h>

#include <algorithm>
#include <array>
#include <iterator>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// An array of `PackedShArrays` and its float4 of `PackedSh`.
struct ShVector {
    const char* name;
    std::span<glm::vec4> PackedShArrays::*array;
    glm::vec4 PackedSh::*vector;
};

constexpr ShVector kShVectors[] = {
    {"sha_r", &PackedShArrays::sha_r, &PackedSh::sha_r},
    {"sha_g", &PackedShArrays::sha_g, &PackedSh::sha_g},
    {"sha_b", &PackedShArrays::sha_b, &PackedSh::sha_b},
    {"shb_r", &PackedShArrays::shb_r, &PackedSh::shb_r},
    {"shb_g", &PackedShArrays::shb_g, &PackedSh::shb_g},
    {"shb_b", &PackedShArrays::shb_b, &PackedSh::shb_b},
    {"shc", &PackedShArrays::shc, &PackedSh::shc},
};

/// Checks all lengths before anything is written.
Status check_lengths(const InstanceBatch& batch) {
    const size_t count = batch.positions.size();
    for (const ShVector& vector : kShVectors) {
        const auto status = check_length(vector.name, (batch.arrays.*vector.array).size(), count);
        if (!status) return status;
    }
    if (!batch.hints.empty()) {
        const auto status = check_length("hints", batch.hints.size(), count);
        if (!status) return status;
    }
    if (batch.occlusion.memory.empty()) return Ok{};
    return check_length("occlusion", batch.occlusion.capacity(), count);
}

void scatter(std::span<const PackedSh> answers, const PackedShArrays& arrays, size_t begin) {
    for (const ShVector& vector : kShVectors) {
        glm::vec4* to = (arrays.*vector.array).data() + begin;
        for (const PackedSh& answer : answers) *to++ = answer.*vector.vector;
    }
}

Status check(const InstanceBatch& batch) {
    if (batch.arrays.empty()) {
        if (batch.packed.memory.empty() || batch.packed.format == ShFormat::Packed) return Ok{};
        return Error{ErrorCode::InvalidArgument, "packed", "",
                     "packed does not have the format Packed"};
    }
    if (!batch.packed.memory.empty())
        return Error{ErrorCode::InvalidArgument, "packed", "", "arrays and packed are both given"};
    return check_lengths(batch);
}

InterpolationBatch without_arrays(const InstanceBatch& batch) {
    InterpolationBatch all;
    all.positions = batch.positions;
    all.hints = batch.hints;
    all.irradiance = batch.packed;
    all.occlusion = batch.occlusion;
    all.outside = batch.outside;
    all.walls = batch.walls;
    all.rendering_layers = batch.rendering_layers;
    all.radii = batch.radii;
    return all;
}

void add(BatchReport& sum, const BatchReport& part) {
    sum.not_finite_count += part.not_finite_count;
    sum.step_count += part.step_count;
    sum.fallback_count += part.fallback_count;
}

/// Writes the light through a block on the stack to its arrays.
Result<BatchReport> pack_arrays(const ProbeVolumeView& volume, const InterpolationBatch& all,
                                const PackedShArrays& arrays) {
    constexpr size_t kBlockSize = 128;
    std::array<PackedSh, kBlockSize> block;
    BatchReport sum;
    for (size_t begin = 0; begin < all.positions.size(); begin += kBlockSize) {
        const size_t count = std::min(kBlockSize, all.positions.size() - begin);
        const std::span answers = std::span(block).first(count);
        InterpolationBatch part = part_of(all, begin, count);
        part.irradiance = answers;
        const auto report = interpolate(volume, part);
        if (!report) return report.error();
        add(sum, *report);
        scatter(answers, arrays, begin);
    }
    return sum;
}

}  // namespace

bool PackedShArrays::empty() const noexcept {
    return std::all_of(std::begin(kShVectors), std::end(kShVectors),
                       [&](const ShVector& vector) { return (this->*vector.array).empty(); });
}

Result<BatchReport> pack_instances(const ProbeVolumeView& volume, const InstanceBatch& batch) {
    if (auto status = check(batch); !status) return status.error();
    const InterpolationBatch all = without_arrays(batch);
    if (batch.arrays.empty()) return interpolate(volume, all);
    if (auto status = check_receivers(all); !status) return status.error();
    return pack_arrays(volume, all, batch.arrays);
}

}  // namespace tetralight
