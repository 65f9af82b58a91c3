// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tetralight {

inline constexpr std::string_view kHexDigits = "0123456789abcdef";

/// The two lower-case hexadecimal digits of each byte.
[[nodiscard]] inline std::string hex(std::span<const std::byte> bytes) {
    std::string digits;
    digits.reserve(2 * bytes.size());
    for (const std::byte byte : bytes) {
        digits += kHexDigits[std::to_integer<size_t>(byte >> 4)];
        digits += kHexDigits[std::to_integer<size_t>(byte & std::byte{15})];
    }
    return digits;
}

/// The last `digit_count` hexadecimal digits of a number, with leading zeros.
[[nodiscard]] inline std::string hex(uint64_t number, size_t digit_count = 16) {
    std::string digits(digit_count, '0');
    for (size_t i = digit_count; i > 0 && number != 0; --i, number >>= 4) {
        digits[i - 1] = kHexDigits[number & 15];
    }
    return digits;
}

}  // namespace tetralight
