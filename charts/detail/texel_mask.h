// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace tetralight::detail {

/// A set of the texels of a rectangle: one bit each, rows of whole words.
struct TexelMask {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t words_per_row = 0;
    std::vector<uint64_t> words;  ///< texel (x, y): bit x % 64 of word y * words_per_row + x / 64

    bool operator==(const TexelMask&) const = default;
};

[[nodiscard]] TexelMask make_texel_mask(uint32_t width, uint32_t height);

/// Adds the texels [x_begin, x_end) of row y. Precondition: they lie in the rectangle.
void add_span(TexelMask& mask, uint32_t y, uint32_t x_begin, uint32_t x_end);

/// The texels of the rectangle that are in the mask or have one of its texels as neighbor,
/// diagonals included.
[[nodiscard]] TexelMask dilate_mask(const TexelMask& mask);

[[nodiscard]] uint64_t texel_count(const TexelMask& mask);

/// Texels [begin, begin + length) of some rows, all of which are in a mask.
struct MaskBlock {
    uint32_t begin = 0;
    uint32_t length = 0;
    std::vector<uint32_t> rows;
};

/// Blocks that have each texel of a mask once, those with the longest rows first.
[[nodiscard]] std::vector<MaskBlock> mask_blocks(const TexelMask& mask);

}  // namespace tetralight::detail
