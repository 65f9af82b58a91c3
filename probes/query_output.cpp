// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/query_output.h>

#include <cstdint>

#include <tetralight/base/str_cat.h>

namespace tetralight {

size_t StridedOutput::capacity(size_t count, size_t size) const noexcept {
    // Strides of callers may have a product that size_t cannot hold.
    const uint64_t one = uint64_t{count - 1} * value_stride + size;
    if (memory.size() < one) return 0;
    const size_t rest = memory.size() - static_cast<size_t>(one);
    return answer_stride == 0 ? 1 : rest / answer_stride + 1;
}

ShOutput::ShOutput(std::span<IrradianceSh> answers) noexcept
    : StridedOutput{std::as_writable_bytes(answers), sizeof(IrradianceSh), sizeof(float)} {}

ShOutput::ShOutput(std::span<PackedSh> answers) noexcept
    : StridedOutput{std::as_writable_bytes(answers), sizeof(PackedSh), sizeof(float)},
      format(ShFormat::Packed) {}

OcclusionOutput::OcclusionOutput(std::span<glm::vec4> answers) noexcept
    : StridedOutput{std::as_writable_bytes(answers), sizeof(glm::vec4), sizeof(float)} {}

ShOutput strided(std::span<std::byte> memory, ShFormat format, size_t answer_stride) noexcept {
    ShOutput output;
    output.memory = memory;
    output.answer_stride = answer_stride;
    output.value_stride = value_size(format);
    output.format = format;
    return output;
}

OcclusionOutput strided_occlusion(std::span<std::byte> memory, size_t answer_stride) noexcept {
    OcclusionOutput output;
    output.memory = memory;
    output.answer_stride = answer_stride;
    output.value_stride = sizeof(float);
    return output;
}

ShOutput arrays(std::span<std::byte> memory, ShFormat format) noexcept {
    ShOutput output;
    const size_t size = value_size(format);
    output.memory = memory;
    output.answer_stride = size;
    output.value_stride = memory.size() / value_count(format) / size * size;
    output.format = format;
    return output;
}

Status check_strides(const char* name, const StridedOutput& output, size_t count, size_t size,
                     size_t answer_count) {
    const auto address = reinterpret_cast<uintptr_t>(output.memory.data());
    if ((address | output.answer_stride | output.value_stride) % size != 0) {
        return Error{ErrorCode::InvalidArgument, name, "",
                     str_cat(name, " is not aligned to ", size, " bytes")};
    }
    if (answer_count <= 1) return Ok{};
    const uint64_t answer = uint64_t{count - 1} * output.value_stride + size;
    const uint64_t array = uint64_t{answer_count - 1} * output.answer_stride + size;
    const bool is_apart = output.value_stride >= size && output.answer_stride >= size &&
                          (output.answer_stride >= answer || output.value_stride >= array);
    if (is_apart) return Ok{};
    return Error{ErrorCode::InvalidArgument, name, "",
                 str_cat(name, " has a stride of ", output.answer_stride, " bytes, and answers of ",
                         count * size)};
}

Status check_length(const char* name, size_t length, size_t needed) {
    if (length >= needed) return Ok{};
    return Error{
        ErrorCode::InvalidArgument, name, "",
        str_cat(name, " has room for ", length, " answers, but there are ", needed, " positions")};
}

}  // namespace tetralight
