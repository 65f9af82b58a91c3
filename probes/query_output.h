// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/sh.h>

// Where a batch of queries writes its answers. The caller owns the memory, which may be an instance
// buffer with other members between the answers:
//
//     struct Instance { glm::mat4 world; PackedSh light; };
//     strided(std::as_writable_bytes(std::span(instances)).subspan(64), ShFormat::Packed,
//             sizeof(Instance));

namespace tetralight {

/// How irradiance is written.
enum class ShFormat : uint8_t {
    Coefficients,  ///< 27 floats, as `IrradianceSh`
    Packed,        ///< 28 floats, as `PackedSh`: the seven float4 that shaders read
    Half,          ///< 27 half floats, in the order of `IrradianceSh`
};

[[nodiscard]] constexpr size_t value_count(ShFormat format) noexcept {
    return format == ShFormat::Packed ? 28 : 27;
}

[[nodiscard]] constexpr size_t value_size(ShFormat format) noexcept {
    return format == ShFormat::Half ? 2 : 4;
}

/// Value k of answer i lies at byte i · answer_stride + k · value_stride of `memory`.
struct StridedOutput {
    std::span<std::byte> memory;
    size_t answer_stride = 0;
    size_t value_stride = 0;

    /// Number of answers of `count` values of `size` bytes that the memory can hold.
    [[nodiscard]] size_t capacity(size_t count, size_t size) const noexcept;
};

/// Output of irradiance; none by default.
struct ShOutput : StridedOutput {
    ShFormat format = ShFormat::Coefficients;

    ShOutput() = default;
    ShOutput(std::span<IrradianceSh> answers) noexcept;
    ShOutput(std::span<PackedSh> answers) noexcept;

    template <class Container>
    ShOutput(Container& answers) noexcept : ShOutput(std::span(answers)) {}

    [[nodiscard]] size_t capacity() const noexcept {
        return StridedOutput::capacity(value_count(format), value_size(format));
    }
};

/// Output of occlusion, four floats each; none by default.
struct OcclusionOutput : StridedOutput {
    OcclusionOutput() = default;
    OcclusionOutput(std::span<glm::vec4> answers) noexcept;

    template <class Container>
    OcclusionOutput(Container& answers) noexcept : OcclusionOutput(std::span(answers)) {}

    [[nodiscard]] size_t capacity() const noexcept { return StridedOutput::capacity(4, 4); }
};

/// Array of structures: answers `answer_stride` bytes apart, the values of each contiguous.
[[nodiscard]] ShOutput strided(std::span<std::byte> memory, ShFormat format,
                               size_t answer_stride) noexcept;
[[nodiscard]] OcclusionOutput strided_occlusion(std::span<std::byte> memory,
                                                size_t answer_stride) noexcept;

/// Structure of arrays: value 0 of all answers, then value 1 of all, and so on. The memory is
/// divided into one array for each value.
[[nodiscard]] ShOutput arrays(std::span<std::byte> memory, ShFormat format) noexcept;

/// Returns invalid_argument if answers of `count` values of `size` bytes would overlap, or a value
/// would not be aligned to its size. The message holds the stride.
[[nodiscard]] Status check_strides(const char* name, const StridedOutput& output, size_t count,
                                   size_t size, size_t answer_count);

/// Returns invalid_argument, with both lengths in the message, if `length` is less than `needed`.
[[nodiscard]] Status check_length(const char* name, size_t length, size_t needed);

}  // namespace tetralight
