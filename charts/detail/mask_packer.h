// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/charts/detail/texel_mask.h>

namespace tetralight::detail {

/// A mask with what a search for its place needs.
struct MaskShape {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<MaskBlock> blocks;
};

[[nodiscard]] MaskShape make_mask_shape(const TexelMask& mask);

/// Places masks into a strip of texels, as close to its start as they fit without touching each
/// other's texels.
class MaskPacker {
  public:
    struct Place {
        uint32_t x = 0, y = 0;
    };

    MaskPacker(uint32_t width, uint32_t max_height);

    /// Lowest place, and leftmost of those, in row `from_y` or above. Nothing if the mask exceeds
    /// the strip there.
    [[nodiscard]] std::optional<Place> find_place(const MaskShape& shape, uint32_t from_y);

    /// Precondition: the place is from `find_place` for this shape.
    void place(const MaskShape& shape, Place where);

    /// Rows from the first to the last with a texel of a mask.
    [[nodiscard]] uint32_t used_height() const { return used_height_; }

    [[nodiscard]] uint32_t used_width() const { return used_width_; }

  private:
    [[nodiscard]] bool has_room(const MaskShape& shape, uint32_t y) const;
    [[nodiscard]] std::optional<uint32_t> free_column(const MaskShape& shape, uint32_t y);
    void block_columns(const MaskBlock& block, uint32_t y);

    uint32_t max_height_;
    uint32_t used_width_ = 0;
    uint32_t used_height_ = 0;
    TexelMask taken_;
    std::vector<uint32_t> longest_free_;  ///< longest run of free texels in each row
    std::vector<uint64_t> blocked_;       ///< columns at which a mask cannot start
    std::vector<uint64_t> row_;
};

}  // namespace tetralight::detail
