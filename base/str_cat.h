// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace tetralight {

namespace detail {

inline void append_text(std::string& out, std::string_view part) {
    out += part;
}

inline void append_text(std::string& out, char part) {
    out += part;
}

template <class Number>
requires std::integral<Number> || std::floating_point<Number>

void append_text(std::string& out, Number number) {
    char digits[64];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    out.append(digits, end);
}

}  // namespace detail

/// Joins strings and numbers: `str_cat("probe ", 7, ": ", 0.5)`. Numbers are written in the
/// shortest form that reads back to the same value, in every locale.
template <class... Parts>
[[nodiscard]] std::string str_cat(const Parts&... parts) {
    std::string out;
    (detail::append_text(out, parts), ...);
    return out;
}

}  // namespace tetralight
