// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>

#include <tetralight/base/contract.h>

namespace tetralight {

namespace detail {

struct Interval {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();

    void add(double x) {
        min = std::min(min, x);
        max = std::max(max, x);
    }
};

/// The x of the points of a triangle whose y lies in [bottom, top]; `min` > `max` without points.
[[nodiscard]] inline Interval slab_extent(const std::array<glm::vec2, 3>& triangle, double bottom,
                                          double top) noexcept {
    Interval extent;
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a(triangle[k]);
        const glm::dvec2 b(triangle[(k + 1) % 3]);
        if (a.y >= bottom && a.y <= top) extent.add(a.x);
        for (const double y : {bottom, top}) {
            if ((a.y < y && b.y > y) || (b.y < y && a.y > y)) {
                extent.add(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
            }
        }
    }
    return extent;
}

}  // namespace detail

/// Calls visit(y, x_begin, x_end) for each row of texels that touch a triangle: texel (x, y) covers
/// [x, x + 1] × [y, y + 1], is grown by `margin` on each side, and touches if a point of its
/// square, border included, is a point of the triangle, border included. With a margin of 0.5 these
/// are the texels that bilinear filtering reads somewhere in the triangle. Exact but for rounding
/// in double.
///
/// Triangles may have either orientation, or be a segment or a point. Coordinates may be negative.
/// Cost: constant per row. Precondition: coordinates are below 2^30, and margin is in [0, 2^20].
template <class Visit>
void for_each_touched_row(const std::array<glm::vec2, 3>& triangle, float margin, Visit&& visit) {
    const double grown = margin;
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    TETRALIGHT_ASSERT(low > -0x1p30f && high < 0x1p30f && margin >= 0.0f && margin <= 0x1p20f,
                      "coordinates below 2^30, a margin in [0, 2^20]");
    const auto first = static_cast<int32_t>(std::ceil(low - 1.0 - grown));
    const auto last = static_cast<int32_t>(std::floor(high + grown));
    for (int32_t y = first; y <= last; ++y) {
        const detail::Interval extent = detail::slab_extent(triangle, y - grown, y + 1.0 + grown);
        if (extent.min > extent.max) continue;
        const auto x_first = static_cast<int32_t>(std::ceil(extent.min - 1.0 - grown));
        const auto x_last = static_cast<int32_t>(std::floor(extent.max + grown));
        visit(y, x_first, x_last + 1);
    }
}

/// Calls visit(x, y) for each of these texels.
template <class Visit>
void for_each_touched_texel(const std::array<glm::vec2, 3>& triangle, float margin, Visit&& visit) {
    for_each_touched_row(triangle, margin, [&](int32_t y, int32_t x_begin, int32_t x_end) {
        for (int32_t x = x_begin; x < x_end; ++x) visit(x, y);
    });
}

}  // namespace tetralight
