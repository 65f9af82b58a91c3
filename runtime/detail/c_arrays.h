// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/str_cat.h>
#include <tetralight/runtime/detail/c_errors.h>
#include <tetralight/runtime/tetralight.h>

// Checks the pointers, arrays and numbers of C callers before they are used.

namespace tetralight::detail {

/// An optional pointer must be aligned.
[[nodiscard]] CallError check_aligned(const char* name, const void* pointer, size_t alignment);

/// A required pointer must be aligned and not NULL.
[[nodiscard]] CallError check_required(const char* name, const void* pointer, size_t alignment);

/// The same for the alignment of a type.
template <class Type>
[[nodiscard]] CallError check_pointer(const char* name, const Type* pointer) {
    return check_required(name, pointer, alignof(Type));
}

/// Fails if the system refuses one piece of memory of this size for `what`. It is given back at
/// once: the result says nothing about later allocations.
[[nodiscard]] CallError check_memory(const char* what, size_t bytes);

/// `count` floats must be readable and finite.
[[nodiscard]] CallError check_floats(const char* name, const float* floats, size_t count);
[[nodiscard]] CallError check_finite(const char* name, std::span<const float> floats);

/// The bytes of one element of an array, and of one of its numbers.
struct ElementLayout {
    size_t size = 0;
    size_t alignment = 4;
};

/// Gaps between the elements of an array.
enum class Gaps { Allowed, Refused };

/// An array must have room for `count` elements, with aligned numbers.
[[nodiscard]] CallError check_array(const char* name, const tetralight_const_array& array,
                                    size_t count, ElementLayout element, Gaps gaps = Gaps::Allowed);
[[nodiscard]] CallError check_array(const char* name, const tetralight_array& array, size_t count,
                                    ElementLayout element, Gaps gaps = Gaps::Allowed);

/// The elements of an output array from one of them to the end.
struct ByteRows {
    std::span<std::byte> memory;
    size_t stride = 0;
};

[[nodiscard]] ByteRows output_of(const tetralight_array& array, size_t element_size, size_t begin);

/// The positions of a checked array in blocks without gaps; they are copied if the array has gaps.
class PositionBlocks {
  public:
    PositionBlocks(const tetralight_const_array& positions, size_t count)
        : array_(positions), count_(count) {}

    /// Goes to the next block; false at the end.
    [[nodiscard]] bool next();

    [[nodiscard]] size_t begin() const { return begin_; }

    [[nodiscard]] std::span<const glm::vec3> positions() const { return positions_; }

  private:
    tetralight_const_array array_;
    size_t count_;
    size_t begin_ = 0;
    std::span<const glm::vec3> positions_;
    std::array<glm::vec3, 1024> copies_;
};

}  // namespace tetralight::detail
