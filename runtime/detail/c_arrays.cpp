// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/detail/c_arrays.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>

namespace tetralight::detail {

CallError check_aligned(const char* name, const void* pointer, size_t alignment) {
    if (reinterpret_cast<uintptr_t>(pointer) % alignment == 0) return {};
    return {TETRALIGHT_BAD_POINTER, str_cat(name, " is not aligned to ", alignment, " bytes")};
}

CallError check_required(const char* name, const void* pointer, size_t alignment) {
    if (!pointer) return {TETRALIGHT_BAD_POINTER, str_cat(name, " is NULL")};
    return check_aligned(name, pointer, alignment);
}

CallError check_memory(const char* what, size_t bytes) {
    // Compilers may remove an allocation that is not used, but not a volatile one.
    void* volatile memory = ::operator new(bytes, std::nothrow);
    if (!memory) {
        return {TETRALIGHT_OUT_OF_MEMORY, str_cat("no memory for ", what, ": ", bytes, " bytes")};
    }
    ::operator delete(memory);
    return {};
}

CallError check_floats(const char* name, const float* floats, size_t count) {
    if (auto wrong = check_pointer(name, floats)) return wrong;
    return check_finite(name, {floats, count});
}

CallError check_finite(const char* name, std::span<const float> floats) {
    for (size_t i = 0; i < floats.size(); ++i) {
        if (std::isfinite(floats[i])) continue;
        return {TETRALIGHT_BAD_VALUE, str_cat(name, '[', i, "] is not finite: ", floats[i])};
    }
    return {};
}

CallError check_array(const char* name, const tetralight_const_array& array, size_t count,
                      ElementLayout element, Gaps gaps) {
    if (count == 0) return {};
    if (auto wrong = check_required(name, array.data, element.alignment)) return wrong;
    const size_t stride = array.stride == 0 ? element.size : array.stride;
    const bool is_gap = stride != element.size;
    if (stride < element.size || stride % element.alignment != 0 ||
        (is_gap && gaps == Gaps::Refused)) {
        return {TETRALIGHT_BAD_VALUE, str_cat(name, " has a stride of ", stride,
                                              " bytes, and elements of ", element.size)};
    }
    const bool is_long =
        array.size >= element.size && (array.size - element.size) / stride + 1 >= count;
    if (is_long) return {};
    return {TETRALIGHT_SHORT_BUFFER,
            str_cat(name, " is ", array.size, " bytes long, too short for ", count, " elements of ",
                    element.size, " bytes, ", stride, " bytes apart")};
}

CallError check_array(const char* name, const tetralight_array& array, size_t count,
                      ElementLayout element, Gaps gaps) {
    return check_array(name, tetralight_const_array{array.data, array.size, array.stride}, count,
                       element, gaps);
}

ByteRows output_of(const tetralight_array& array, size_t element_size, size_t begin) {
    const size_t stride = array.stride == 0 ? element_size : array.stride;
    const std::span bytes(static_cast<std::byte*>(array.data), array.size);
    return {bytes.subspan(begin * stride), stride};
}

bool PositionBlocks::next() {
    begin_ += positions_.size();
    if (begin_ >= count_) return false;
    const size_t stride = array_.stride == 0 ? sizeof(glm::vec3) : array_.stride;
    if (stride == sizeof(glm::vec3)) {
        positions_ = {static_cast<const glm::vec3*>(array_.data), count_};
        return true;
    }
    const auto* from = static_cast<const std::byte*>(array_.data) + begin_ * stride;
    const size_t count = std::min(copies_.size(), count_ - begin_);
    for (size_t i = 0; i < count; ++i) {
        std::memcpy(static_cast<void*>(&copies_[i]), from + i * stride, sizeof(glm::vec3));
    }
    positions_ = std::span(copies_).first(count);
    return true;
}

}  // namespace tetralight::detail
