// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/runtime/tetralight.h>

// What C callers hand in, checked before it is touched.

namespace tetralight::detail {

/// Why a call of the C API fails; true where it does.
struct CallError {
    tetralight_status status = TETRALIGHT_OK;
    std::string message;

    explicit operator bool() const { return status != TETRALIGHT_OK; }
};

/// Hands an error, or an empty message, to the caller.
tetralight_status finish(const CallError& wrong, tetralight_error* error);

/// What every call that succeeds ends with.
inline tetralight_status succeed(tetralight_error* error) {
    return finish({}, error);
}

[[nodiscard]] CallError check_aligned(const char* name, const void* pointer, size_t alignment);
[[nodiscard]] CallError check_place(const char* name, const void* pointer, size_t alignment);

/// Whether a pointer that is needed leads to a place for its type.
template <class Type>
[[nodiscard]] CallError check_pointer(const char* name, const Type* pointer) {
    return check_place(name, pointer, alignof(Type));
}

/// Whether the system has this much memory to give; `what` is for.
[[nodiscard]] CallError check_memory(const char* what, size_t bytes);

/// Floats that are handed in one by one: there, and all finite.
[[nodiscard]] CallError check_floats(const char* name, const float* floats, size_t count);
[[nodiscard]] CallError check_finite(const char* name, std::span<const float> floats);

/// One element of an array: its bytes, and those of one of its numbers.
struct ElementLayout {
    size_t size = 0;
    size_t alignment = 4;
};

/// Whether elements may lie apart.
enum class Gaps { Allowed, Refused };

/// Whether an array holds `count` elements, its numbers aligned.
[[nodiscard]] CallError check_array(const char* name, const tetralight_const_array& array,
                                    size_t count, ElementLayout element, Gaps gaps = Gaps::Allowed);
[[nodiscard]] CallError check_array(const char* name, const tetralight_array& array, size_t count,
                                    ElementLayout element, Gaps gaps = Gaps::Allowed);

/// Elements from one on, as answers are written.
struct ByteRows {
    std::span<std::byte> memory;
    size_t stride = 0;
};

[[nodiscard]] ByteRows output_of(const tetralight_array& array, size_t element_size, size_t begin);

/// The positions of a checked array in blocks without gaps: as they lie, or copied.
class PositionBlocks {
  public:
    PositionBlocks(const tetralight_const_array& positions, size_t count)
        : array_(positions), count_(count) {}

    /// Goes to the next block. False: there is none.
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
