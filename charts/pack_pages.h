// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight {

struct TexelSize {
    uint32_t width = 0;
    uint32_t height = 0;

    bool operator==(const TexelSize&) const = default;
};

/// Where a rectangle lies: its least corner in texels from the corner of a page.
struct PagePlace {
    uint32_t page = 0;
    uint32_t x = 0;
    uint32_t y = 0;

    bool operator==(const PagePlace&) const = default;
};

/// Places rectangles in square pages, in whole texels, without rotation and without overlap.
/// Several orders are tried; the one that needs the fewest pages, and the fewest rows of the last,
/// wins. Places are in the order of `sizes`. Rectangles of no width or height are at (0, 0) of page
/// 0.
///
/// Returns invalid_argument, with `rectangles[i]` as field, if one is larger than a page.
/// Precondition: `page_size` > 0.
[[nodiscard]] Result<std::vector<PagePlace>> pack_pages(std::span<const TexelSize> sizes,
                                                        uint32_t page_size);

}  // namespace tetralight
