// SPDX-License-Identifier: Apache-2.0
#include "runtime/detail/c_arrays.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tetralight::detail {

tetralight_status finish(const CallError& wrong, tetralight_error* error) {
    if (error) {
        const size_t length = std::min(wrong.message.size(), sizeof error->message - 1);
        std::memcpy(error->message, wrong.message.data(), length);
        error->message[length] = '\0';
    }
    return wrong.status;
}

CallError check_array(const char* name, const tetralight_const_array& array, size_t count,
                      ElementLayout element, Gaps gaps) {
    if (count == 0) return {};
    if (!array.data) return {TETRALIGHT_BAD_POINTER, text(name, " is NULL")};
    if (reinterpret_cast<uintptr_t>(array.data) % element.alignment != 0) {
        return {TETRALIGHT_BAD_POINTER,
                text(name, " is not aligned to ", element.alignment, " bytes")};
    }
    const size_t stride = array.stride == 0 ? element.size : array.stride;
    const bool is_gap = stride != element.size;
    if (stride < element.size || stride % element.alignment != 0 ||
        (is_gap && gaps == Gaps::Refused)) {
        return {TETRALIGHT_BAD_VALUE,
                text(name, " has a stride of ", stride, " bytes, and elements of ", element.size)};
    }
    const bool is_long =
        array.size >= element.size && (array.size - element.size) / stride + 1 >= count;
    if (is_long) return {};
    return {TETRALIGHT_SHORT_BUFFER,
            text(name, " is ", array.size, " bytes long, too short for ", count, " elements of ",
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
