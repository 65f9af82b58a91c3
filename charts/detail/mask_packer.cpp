// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/mask_packer.h>

#include <algorithm>
#include <bit>

#include <tetralight/base/contract.h>

namespace tetralight::detail {

namespace {

/// Bits of a row, moved `shift` places towards its start; word i of the result.
uint64_t shifted_word(std::span<const uint64_t> row, size_t i, uint32_t shift) {
    const size_t from = i + shift / 64;
    const uint32_t bits = shift % 64;
    const uint64_t low = from < row.size() ? row[from] >> bits : 0;
    if (bits == 0 || from + 1 >= row.size()) return low;
    return low | row[from + 1] << (64 - bits);
}

/// Sets each bit that has a set bit among the `length` bits from it on.
void spread_down(std::span<uint64_t> row, uint32_t length) {
    for (uint32_t reach = 1; reach < length;) {
        const uint32_t step = std::min(reach, length - reach);
        for (size_t i = 0; i < row.size(); ++i) row[i] |= shifted_word(row, i, step);
        reach += step;
    }
}

uint32_t longest_free_run(std::span<const uint64_t> row, uint32_t width) {
    uint32_t longest = 0;
    uint32_t begin = 0;
    for (uint32_t i = 0; i < row.size(); ++i) {
        for (uint32_t bit = 0; bit < 64;) {
            const uint64_t word = row[i] >> bit;
            if (word == 0) break;
            bit += static_cast<uint32_t>(std::countr_zero(word));
            longest = std::max(longest, 64 * i + bit - begin);
            bit += static_cast<uint32_t>(std::countr_one(row[i] >> bit));
            begin = 64 * i + bit;
        }
    }
    return std::max(longest, width - std::min(begin, width));
}

}  // namespace

MaskShape make_mask_shape(const TexelMask& mask) {
    return {mask.width, mask.height, mask_blocks(mask)};
}

MaskPacker::MaskPacker(uint32_t width, uint32_t max_height)
    : max_height_(max_height),
      taken_(make_texel_mask(width, max_height)),
      longest_free_(max_height, width),
      blocked_(taken_.words_per_row),
      row_(taken_.words_per_row) {}

bool MaskPacker::has_room(const MaskShape& shape, uint32_t y) const {
    for (const MaskBlock& block : shape.blocks) {
        for (const uint32_t row : block.rows) {
            if (longest_free_[y + row] < block.length) return false;
        }
    }
    return true;
}

void MaskPacker::block_columns(const MaskBlock& block, uint32_t y) {
    std::ranges::fill(row_, 0);
    for (const uint32_t mask_row : block.rows) {
        if (y + mask_row >= used_height_) continue;
        const uint64_t* const taken = &taken_.words[size_t{y + mask_row} * row_.size()];
        for (size_t i = 0; i < row_.size(); ++i) row_[i] |= taken[i];
    }
    spread_down(row_, block.length);
    for (size_t i = 0; i < row_.size(); ++i) blocked_[i] |= shifted_word(row_, i, block.begin);
}

std::optional<uint32_t> MaskPacker::free_column(const MaskShape& shape, uint32_t y) {
    const uint32_t columns = taken_.width - shape.width + 1;
    std::ranges::fill(blocked_, ~uint64_t{0});
    std::fill_n(blocked_.begin(), columns / 64, 0);
    if (columns % 64 != 0) blocked_[columns / 64] = ~uint64_t{0} << columns % 64;
    const auto is_full = [](uint64_t word) { return word == ~uint64_t{0}; };
    for (const MaskBlock& block : shape.blocks) {
        block_columns(block, y);
        if (std::ranges::all_of(blocked_, is_full)) return std::nullopt;
    }
    const auto word = std::ranges::find_if_not(blocked_, is_full) - blocked_.begin();
    return static_cast<uint32_t>(64 * word + std::countr_one(blocked_[static_cast<size_t>(word)]));
}

std::optional<MaskPacker::Place> MaskPacker::find_place(const MaskShape& shape, uint32_t from_y) {
    if (shape.width > taken_.width || shape.height > max_height_) return std::nullopt;
    for (uint32_t y = from_y; y + shape.height <= max_height_; ++y) {
        if (!has_room(shape, y)) continue;
        if (const auto x = free_column(shape, y)) return Place{*x, y};
    }
    return std::nullopt;
}

void MaskPacker::place(const MaskShape& shape, Place where) {
    for (const MaskBlock& block : shape.blocks) {
        for (const uint32_t row : block.rows) {
            const uint32_t x = where.x + block.begin;
            add_span(taken_, where.y + row, x, x + block.length);
        }
    }
    used_width_ = std::max(used_width_, where.x + shape.width);
    used_height_ = std::max(used_height_, where.y + shape.height);
    for (uint32_t y = where.y; y < where.y + shape.height; ++y) {
        const size_t stride = taken_.words_per_row;
        longest_free_[y] = longest_free_run({&taken_.words[y * stride], stride}, taken_.width);
    }
}

}  // namespace tetralight::detail
