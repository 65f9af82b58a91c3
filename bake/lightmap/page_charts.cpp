// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/page_charts.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

namespace tetralight {

PageCharts::PageCharts(uint32_t page_size, uint32_t page_count)
    : page_size_(static_cast<int>(page_size)),
      chart_of_texel_(size_t{page_size} * page_size * page_count, kNoIndex),
      texels_(chart_of_texel_.size(), kNoIndex),
      first_border_(1, 0) {}

size_t PageCharts::index_of(uint32_t page, glm::ivec2 place) const {
    const auto size = static_cast<size_t>(page_size_);
    return (page * size + static_cast<size_t>(place.y)) * size + static_cast<size_t>(place.x);
}

bool PageCharts::is_in_page(glm::ivec2 place) const {
    return place.x >= 0 && place.y >= 0 && place.x < page_size_ && place.y < page_size_;
}

void PageCharts::add(uint32_t page, glm::ivec2 corner, uint32_t width,
                     std::span<const uint32_t> charts) {
    std::map<uint32_t, uint32_t> numbers;
    for (uint32_t i = 0; i < charts.size(); ++i) {
        if (charts[i] == kNoIndex) continue;
        const glm::ivec2 place = corner + glm::ivec2(i % width, i / width);
        const auto [number, is_new] =
            numbers.try_emplace(charts[i], static_cast<uint32_t>(charts_.size()));
        if (is_new) charts_.push_back({page, place, place + 1});
        Chart& chart = charts_[number->second];
        chart.low = glm::min(chart.low, place);
        chart.high = glm::max(chart.high, place + 1);
        chart_of_texel_[index_of(page, place)] = number->second;
    }
    first_border_.resize(charts_.size() + 1, 0);
}

void PageCharts::set_texel(uint32_t page, glm::ivec2 place, uint32_t texel) {
    texels_[index_of(page, place)] = texel;
}

uint32_t PageCharts::chart_at(uint32_t page, glm::vec2 point) const {
    const glm::ivec2 place(glm::floor(point));
    return is_in_page(place) ? chart_of_texel_[index_of(page, place)] : kNoIndex;
}

std::pair<uint32_t, glm::vec2> PageCharts::side_of(const PageEdge& edge) const {
    // Farther than the texels that bilinear filtering reads.
    constexpr float kOff = 1.5f;
    const glm::vec2 along = edge.end - edge.begin;
    const float length = glm::length(along);
    if (!(length > 0.0f)) return {kNoIndex, {}};
    const glm::vec2 normal = glm::vec2(-along.y, along.x) / length;
    for (const float t : {0.5f, 0.25f, 0.75f}) {
        const glm::vec2 point = edge.begin + t * along;
        const uint32_t left = chart_at(edge.page, point + kOff * normal);
        const uint32_t right = chart_at(edge.page, point - kOff * normal);
        if (left != kNoIndex && right == kNoIndex) return {left, normal};
        if (left == kNoIndex && right != kNoIndex) return {right, -normal};
    }
    return {kNoIndex, {}};
}

void PageCharts::add_border(const PageEdge& edge, const PageEdge& other) {
    const auto [chart, inside] = side_of(edge);
    const auto [other_chart, other_inside] = side_of(other);
    if (chart == kNoIndex || other_chart == kNoIndex) return;
    const glm::vec2 along = edge.end - edge.begin, other_along = other.end - other.begin;
    borders_.push_back({chart, other_chart, other.page, edge.begin, along, -inside, other.begin,
                        other_along,
                        other_inside * (glm::length(other_along) / glm::length(along))});
}

void PageCharts::add_seams(std::span<const Seam> seams) {
    for (const Seam& seam : seams) {
        add_border(seam.first, seam.second);
        add_border(seam.second, seam.first);
    }
    std::ranges::stable_sort(borders_, {}, &Border::chart);
    for (uint32_t chart = 0; chart <= charts_.size(); ++chart) {
        const auto first = std::ranges::lower_bound(borders_, chart, {}, &Border::chart);
        first_border_[chart] = static_cast<uint32_t>(first - borders_.begin());
    }
}

std::vector<PageCharts::Tile> PageCharts::tiles() const {
    constexpr int kSize = 32;
    std::vector<Tile> tiles;
    for (uint32_t i = 0; i < charts_.size(); ++i) {
        const Chart& chart = charts_[i];
        for (int y = chart.low.y; y < chart.high.y; y += kSize) {
            for (int x = chart.low.x; x < chart.high.x; x += kSize) {
                const glm::ivec2 low(x, y);
                tiles.push_back({i, low, glm::min(low + kSize, chart.high)});
            }
        }
    }
    return tiles;
}

uint32_t PageCharts::texel_of(uint32_t chart, glm::ivec2 place) const {
    const size_t index = index_of(charts_[chart].page, place);
    return chart_of_texel_[index] == chart ? texels_[index] : kNoIndex;
}

void PageCharts::copy_texels(uint32_t chart, glm::ivec2 low, glm::ivec2 size,
                             std::span<uint32_t> texels) const {
    std::ranges::fill(texels, kNoIndex);
    const Chart& own = charts_[chart];
    const glm::ivec2 begin = glm::max(low, own.low), end = glm::min(low + size, own.high);
    for (int y = begin.y; y < end.y; ++y) {
        for (int x = begin.x; x < end.x; ++x) {
            texels[static_cast<size_t>((y - low.y) * size.x + x - low.x)] = texel_of(chart, {x, y});
        }
    }
    for (uint32_t i = first_border_[chart]; i < first_border_[chart + 1]; ++i)
        continue_across(borders_[i], low, size, texels);
}

void PageCharts::continue_across(const Border& border, glm::ivec2 low, glm::ivec2 size,
                                 std::span<uint32_t> texels) const {
    // Nothing reaches farther than the part that is copied.
    const float reach = static_cast<float>(std::max(size.x, size.y));
    const glm::vec2 end = border.begin + border.along;
    const glm::vec2 far = reach * border.outside;
    const glm::vec2 least =
        glm::min(glm::min(border.begin, end), glm::min(border.begin + far, end + far));
    const glm::vec2 most =
        glm::max(glm::max(border.begin, end), glm::max(border.begin + far, end + far));
    const glm::ivec2 first = glm::max(low, glm::ivec2(glm::floor(least)));
    const glm::ivec2 last = glm::min(low + size - 1, glm::ivec2(glm::floor(most)));
    const float square = glm::dot(border.along, border.along);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            uint32_t& texel = texels[static_cast<size_t>((y - low.y) * size.x + x - low.x)];
            if (texel != kNoIndex) continue;
            const glm::vec2 offset = glm::vec2(x, y) + 0.5f - border.begin;
            const float depth = glm::dot(offset, border.outside);
            const float t = glm::dot(offset, border.along) / square;
            if (depth < 0.0f || t < 0.0f || t > 1.0f) continue;
            const glm::vec2 there =
                border.other_begin + t * border.other_along + depth * border.other_inside;
            if (chart_at(border.other_page, there) != border.other_chart) continue;
            texel = texels_[index_of(border.other_page, glm::ivec2(glm::floor(there)))];
        }
    }
}

}  // namespace tetralight
