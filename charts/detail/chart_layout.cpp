// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/chart_layout.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace tetralight::detail {

namespace {

/// Finalizer of SplitMix64 (Steele, Lea & Flood 2014).
uint64_t mix_bits(uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

constexpr double kFarthestCell = 0x1p52;

int64_t cell_at(double coordinate, int exponent) {
    const double cell = std::floor(std::ldexp(coordinate, -exponent));
    return static_cast<int64_t>(std::clamp(cell, -kFarthestCell, kFarthestCell));
}

}  // namespace

ChartLayout::CellRange ChartLayout::cells_of(const Bounds& bounds, int exponent) {
    return {cell_at(bounds.min.x, exponent), cell_at(bounds.min.y, exponent),
            cell_at(bounds.max.x, exponent), cell_at(bounds.max.y, exponent)};
}

bool ChartLayout::overlaps_one(const FlatTriangle& triangle, const Bounds& bounds,
                               uint32_t other) const {
    const Bounds& b = bounds_[other];
    if (bounds.max.x <= b.min.x || b.max.x <= bounds.min.x) return false;
    if (bounds.max.y <= b.min.y || b.max.y <= bounds.min.y) return false;
    return overlap(triangle, triangles_[other]);
}

bool ChartLayout::overlaps_cell(const FlatTriangle& triangle, const Bounds& bounds,
                                const Cell& cell) const {
    for (uint32_t next = slots_[slot_of(cell)].first; next != 0; next = entries_[next - 1].next) {
        if (overlaps_one(triangle, bounds, entries_[next - 1].triangle)) return true;
    }
    return false;
}

bool ChartLayout::overlaps_level(const FlatTriangle& triangle, const Bounds& bounds,
                                 uint32_t level) const {
    const CellRange range = cells_of(bounds, levels_[level].exponent);
    const std::vector<uint32_t>& all = levels_[level].triangles;
    if (range.count() >= static_cast<double>(all.size())) {
        return std::ranges::any_of(
            all, [&](uint32_t other) { return overlaps_one(triangle, bounds, other); });
    }
    for (int64_t y = range.min_y; y <= range.max_y; ++y) {
        for (int64_t x = range.min_x; x <= range.max_x; ++x) {
            if (overlaps_cell(triangle, bounds, {x, y, level})) return true;
        }
    }
    return false;
}

uint32_t ChartLayout::level_for(const Bounds& bounds) {
    const glm::dvec2 size = bounds.max - bounds.min;
    const int exponent = std::ilogb(std::max(size.x, size.y)) + 1;
    for (uint32_t i = 0; i < level_count_; ++i) {
        if (levels_[i].exponent == exponent) return i;
    }
    if (level_count_ == levels_.size()) levels_.emplace_back();
    levels_[level_count_].exponent = exponent;
    levels_[level_count_].triangles.clear();
    return level_count_++;
}

bool ChartLayout::try_add(const FlatTriangle& triangle) {
    if (slots_.empty()) grow_slots();
    const Bounds bounds{glm::min(glm::min(triangle[0], triangle[1]), triangle[2]),
                        glm::max(glm::max(triangle[0], triangle[1]), triangle[2])};
    for (uint32_t level = 0; level < level_count_; ++level) {
        if (overlaps_level(triangle, bounds, level)) return false;
    }
    const uint32_t level = level_for(bounds);
    const auto index = static_cast<uint32_t>(triangles_.size());
    triangles_.push_back(triangle);
    bounds_.push_back(bounds);
    levels_[level].triangles.push_back(index);
    const CellRange range = cells_of(bounds, levels_[level].exponent);
    for (int64_t y = range.min_y; y <= range.max_y; ++y) {
        for (int64_t x = range.min_x; x <= range.max_x; ++x) add_to_cell({x, y, level}, index);
    }
    return true;
}

size_t ChartLayout::slot_of(const Cell& cell) const {
    uint64_t hash = mix_bits(static_cast<uint64_t>(cell.x) + 0x9e3779b97f4a7c15u * cell.level);
    hash = mix_bits(hash ^ static_cast<uint64_t>(cell.y));
    const size_t mask = slots_.size() - 1;
    size_t slot = hash & mask;
    while (slots_[slot].first != 0 && slots_[slot].cell != cell) slot = (slot + 1) & mask;
    return slot;
}

void ChartLayout::add_to_cell(const Cell& cell, uint32_t triangle) {
    if (2 * used_slots_.size() >= slots_.size()) grow_slots();
    const size_t index = slot_of(cell);
    Slot& slot = slots_[index];
    if (slot.first == 0) used_slots_.push_back(static_cast<uint32_t>(index));
    slot.cell = cell;
    entries_.push_back({triangle, slot.first});
    slot.first = static_cast<uint32_t>(entries_.size());
}

void ChartLayout::grow_slots() {
    const std::vector<Slot> old =
        std::exchange(slots_, std::vector<Slot>(std::max<size_t>(64, 2 * slots_.size())));
    for (uint32_t& used : used_slots_) {
        const size_t slot = slot_of(old[used].cell);
        slots_[slot] = old[used];
        used = static_cast<uint32_t>(slot);
    }
}

void ChartLayout::clear() {
    for (const uint32_t used : used_slots_) slots_[used] = {};
    used_slots_.clear();
    entries_.clear();
    triangles_.clear();
    bounds_.clear();
    level_count_ = 0;
}

}  // namespace tetralight::detail
