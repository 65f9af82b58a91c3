// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <tetralight/charts/pack_pages.h>

namespace tetralight::detail {

/// A page that is filled from y = 0 on. Its skyline is the upper border of the filled part, as
/// segments of constant y (Jylänki 2010, "A Thousand Ways to Pack the Bin"). Gaps below the
/// skyline are kept as rectangles and filled first.
class Skyline {
  public:
    explicit Skyline(uint32_t page_size);

    /// Places a rectangle where it wastes least, if it fits. `page` of the result is 0.
    [[nodiscard]] std::optional<PagePlace> try_place(TexelSize size);

    [[nodiscard]] uint32_t used_height() const { return used_height_; }

  private:
    struct Segment {
        uint32_t x = 0;
        uint32_t y = 0;
        uint32_t width = 0;
    };

    struct Gap {
        uint32_t x = 0;
        uint32_t y = 0;
        TexelSize size;
    };

    struct Candidate {
        size_t segment = 0;
        uint32_t y = 0;
        uint64_t waste = 0;  ///< texels between the skyline and the rectangle
    };

    [[nodiscard]] std::optional<PagePlace> place_in_gap(TexelSize size);
    [[nodiscard]] std::optional<Candidate> at_segment(size_t segment, TexelSize size) const;
    void raise(const Candidate& where, TexelSize size);
    void add_gap(const Gap& gap);

    uint32_t page_size_;
    uint32_t used_height_ = 0;
    std::vector<Segment> segments_;
    std::vector<Gap> gaps_;
};

}  // namespace tetralight::detail
