// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include <tetralight/base/str_cat.h>

namespace tetralight {

/// The shortest decimal number that reads back to the same float or double; no ".0" at the end.
template <class Float>
nlohmann::ordered_json shortest_number(Float value) {
    constexpr auto kLargestExact = static_cast<Float>(1u << 24);
    if (std::trunc(value) == value && std::abs(value) <= kLargestExact) {
        return static_cast<int64_t>(value);
    }
    const std::string digits = str_cat(value);
    double number = 0.0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

/// A value of a setting as metadata records it.
template <class T>
nlohmann::ordered_json value_record(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        return shortest_number(value);
    } else if constexpr (std::is_enum_v<T>) {
        return name_of(value);
    } else {
        return value;
    }
}

}  // namespace tetralight
