// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

#include <tetralight/runtime/tetralight.h>

// Arrays that C callers read without a copy. Their `data` is NULL if they are empty.

namespace tetralight::detail {

template <class Element>
[[nodiscard]] tetralight_const_array c_view(std::span<const Element> elements) {
    if (elements.empty()) return {nullptr, 0, sizeof(Element)};
    return {elements.data(), elements.size_bytes(), sizeof(Element)};
}

[[nodiscard]] inline tetralight_const_array c_view(std::string_view text) {
    return c_view(std::span<const char>(text));
}

/// One member of each element.
template <class Element, class Member>
[[nodiscard]] tetralight_const_array c_view(std::span<const Element> elements,
                                            Member Element::*member) {
    tetralight_const_array view = c_view(elements);
    if (!view.data) return view;
    const auto* first = reinterpret_cast<const std::byte*>(&(elements[0].*member));
    view.size -= static_cast<size_t>(first - static_cast<const std::byte*>(view.data));
    view.data = first;
    return view;
}

}  // namespace tetralight::detail
