// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace tetralight::detail {

/// A letter as a bitmap. Lines stand on the seventh row; the last two are for descenders.
struct Glyph {
    static constexpr uint32_t kHeight = 9;
    static constexpr uint32_t kMaxWidth = 8;

    uint8_t advance = 0;                  ///< pixels to the next letter
    std::array<uint8_t, kHeight> rows{};  ///< top row first; bit 0 is the leftmost pixel
};

/// The glyph of an ASCII character; that of '?' for characters that cannot be printed.
[[nodiscard]] const Glyph& glyph_of(char character) noexcept;

}  // namespace tetralight::detail
