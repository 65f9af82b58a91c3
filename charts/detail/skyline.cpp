// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/skyline.h>

#include <algorithm>
#include <tuple>

namespace tetralight::detail {

Skyline::Skyline(uint32_t page_size) : page_size_(page_size), segments_{{0, 0, page_size}} {}

void Skyline::add_gap(const Gap& gap) {
    if (gap.size.width > 0 && gap.size.height > 0) gaps_.push_back(gap);
}

/// The gap that is least larger than the rectangle; what remains becomes two smaller gaps.
std::optional<PagePlace> Skyline::place_in_gap(TexelSize size) {
    const auto spare = [&](const Gap& gap) {
        const bool fits = gap.size.width >= size.width && gap.size.height >= size.height;
        return fits ? uint64_t{gap.size.width} * gap.size.height : UINT64_MAX;
    };
    const auto best = std::ranges::min_element(gaps_, {}, spare);
    if (best == gaps_.end() || spare(*best) == UINT64_MAX) return std::nullopt;
    const Gap gap = *best;
    gaps_.erase(best);
    const uint32_t right = gap.size.width - size.width;
    const uint32_t above = gap.size.height - size.height;
    const bool is_wide = right > above;
    add_gap({gap.x + size.width, gap.y, {right, is_wide ? gap.size.height : size.height}});
    add_gap({gap.x, gap.y + size.height, {is_wide ? size.width : gap.size.width, above}});
    return PagePlace{0, gap.x, gap.y};
}

std::optional<Skyline::Candidate> Skyline::at_segment(size_t segment, TexelSize size) const {
    const uint32_t x = segments_[segment].x;
    if (size.width > page_size_ - x) return std::nullopt;
    uint32_t y = 0;
    uint64_t filled = 0;
    for (size_t i = segment; i < segments_.size() && segments_[i].x < x + size.width; ++i) {
        const Segment& s = segments_[i];
        y = std::max(y, s.y);
        filled += uint64_t{std::min(s.x + s.width, x + size.width) - s.x} * s.y;
    }
    if (size.height > page_size_ - y) return std::nullopt;
    return Candidate{segment, y, uint64_t{size.width} * y - filled};
}

/// Raises the skyline to the top of a rectangle and keeps the gaps below it.
void Skyline::raise(const Candidate& where, TexelSize size) {
    const uint32_t x = segments_[where.segment].x;
    const uint32_t x_end = x + size.width;
    size_t end = where.segment;
    for (; end < segments_.size() && segments_[end].x < x_end; ++end) {
        Segment& s = segments_[end];
        const uint32_t covered = std::min(s.x + s.width, x_end) - s.x;
        add_gap({s.x, s.y, {covered, where.y - s.y}});
        if (covered < s.width) {
            s = {x_end, s.y, s.width - covered};
            break;
        }
    }
    const auto at = segments_.begin();
    const auto next = segments_.erase(at + static_cast<std::ptrdiff_t>(where.segment),
                                      at + static_cast<std::ptrdiff_t>(end));
    segments_.insert(next, {x, where.y + size.height, size.width});
    for (size_t i = 1; i < segments_.size();) {
        if (segments_[i].y != segments_[i - 1].y) {
            ++i;
            continue;
        }
        segments_[i - 1].width += segments_[i].width;
        segments_.erase(segments_.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

std::optional<PagePlace> Skyline::try_place(TexelSize size) {
    std::optional<PagePlace> place = place_in_gap(size);
    if (!place) {
        std::optional<Candidate> best;
        const auto cost = [](const Candidate& c) { return std::tuple(c.y, c.waste, c.segment); };
        for (size_t i = 0; i < segments_.size(); ++i) {
            const std::optional<Candidate> candidate = at_segment(i, size);
            if (candidate && (!best || cost(*candidate) < cost(*best))) best = candidate;
        }
        if (!best) return std::nullopt;
        place = PagePlace{0, segments_[best->segment].x, best->y};
        raise(*best, size);
    }
    used_height_ = std::max(used_height_, place->y + size.height);
    return place;
}

}  // namespace tetralight::detail
