// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/texel_mask.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include <tetralight/base/contract.h>

namespace tetralight::detail {

namespace {

bool has_texel(const TexelMask& mask, uint32_t x, uint32_t y) {
    return (mask.words[size_t{y} * mask.words_per_row + x / 64] >> x % 64 & 1) != 0;
}

void add_row(std::span<uint64_t> to, std::span<const uint64_t> from) {
    for (size_t i = 0; i < to.size(); ++i) to[i] |= from[i];
}

/// Adds the left and right neighbors of each texel; the last word may get bits past the width.
void widen_row(std::span<uint64_t> row) {
    uint64_t carried = 0;
    for (size_t i = 0; i < row.size(); ++i) {
        const uint64_t word = row[i];
        const uint64_t next = i + 1 < row.size() ? row[i + 1] : 0;
        row[i] = word | word << 1 | carried | word >> 1 | next << 63;
        carried = word >> 63;
    }
}

}  // namespace

TexelMask make_texel_mask(uint32_t width, uint32_t height) {
    const uint32_t words_per_row = (width + 63) / 64;
    return {width, height, words_per_row, std::vector<uint64_t>(size_t{words_per_row} * height)};
}

void add_span(TexelMask& mask, uint32_t y, uint32_t x_begin, uint32_t x_end) {
    TETRALIGHT_ASSERT(y < mask.height && x_begin < x_end && x_end <= mask.width,
                      "texels of the rectangle");
    uint64_t* const row = &mask.words[size_t{y} * mask.words_per_row];
    const uint32_t first = x_begin / 64;
    const uint32_t last = (x_end - 1) / 64;
    const uint64_t from_begin = ~uint64_t{0} << x_begin % 64;
    const uint64_t to_end = ~uint64_t{0} >> (63 - (x_end - 1) % 64);
    if (first == last) {
        row[first] |= from_begin & to_end;
        return;
    }
    row[first] |= from_begin;
    std::fill(row + first + 1, row + last, ~uint64_t{0});
    row[last] |= to_end;
}

TexelMask dilate_mask(const TexelMask& mask) {
    TexelMask dilated = mask;
    const size_t stride = mask.words_per_row;
    const uint64_t last_word =
        mask.width % 64 ? ~uint64_t{0} >> (64 - mask.width % 64) : ~uint64_t{0};
    for (uint32_t y = 0; y < mask.height; ++y) {
        const std::span<uint64_t> row(&dilated.words[y * stride], stride);
        if (y > 0) add_row(row, {&mask.words[(y - 1) * stride], stride});
        if (y + 1 < mask.height) add_row(row, {&mask.words[(y + 1) * stride], stride});
        widen_row(row);
        row.back() &= last_word;
    }
    return dilated;
}

uint64_t texel_count(const TexelMask& mask) {
    uint64_t count = 0;
    for (const uint64_t word : mask.words) count += static_cast<uint64_t>(std::popcount(word));
    return count;
}

std::vector<MaskBlock> mask_blocks(const TexelMask& mask) {
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>, std::greater<>> rows_of;
    for (uint32_t y = 0; y < mask.height; ++y) {
        for (uint32_t x = 0; x < mask.width;) {
            const uint32_t begin = x;
            while (x < mask.width && has_texel(mask, x, y)) ++x;
            if (x > begin) rows_of[{x - begin, begin}].push_back(y);
            ++x;
        }
    }
    std::vector<MaskBlock> blocks;
    for (auto& [run, rows] : rows_of) blocks.push_back({run.second, run.first, std::move(rows)});
    return blocks;
}

}  // namespace tetralight::detail
