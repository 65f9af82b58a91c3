// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/cell_sorter.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace tetralight::detail {
namespace {

/// Compares cells that have their first vertex in common by the other three.
bool is_before(const Cell& a, const Cell& b) {
    const uint64_t a_key = uint64_t{a.vertices[1]} << 32 | a.vertices[2];
    const uint64_t b_key = uint64_t{b.vertices[1]} << 32 | b.vertices[2];
    return a_key != b_key ? a_key < b_key : a.vertices[3] < b.vertices[3];
}

}  // namespace

void CellSorter::reserve_places(size_t extra_cells) {
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    next_.assign(begins_.begin(), begins_.end() - 1);
    cells_.reserve(begins_.back() + extra_cells);
    cells_.resize(begins_.back());
    numbers_.resize(begins_.back());
}

/// Moves a cell down to its place among the sorted ones before it.
void CellSorter::insert_in_order(uint32_t begin, uint32_t index) {
    const Cell cell = cells_[index];
    const uint32_t number = numbers_[index];
    uint32_t place = index;
    for (; place > begin && is_before(cell, cells_[place - 1]); --place) {
        cells_[place] = cells_[place - 1];
        numbers_[place] = numbers_[place - 1];
    }
    cells_[place] = cell;
    numbers_[place] = number;
}

/// Sorts the cells of one first vertex: half a dozen, but all of them where a probe has the others
/// around it.
void CellSorter::sort_bucket(uint32_t begin, uint32_t end) {
    constexpr uint32_t kFew = 48;
    if (end - begin <= kFew) {
        for (uint32_t i = begin + 1; i < end; ++i) insert_in_order(begin, i);
        return;
    }
    std::vector<std::pair<Cell, uint32_t>> bucket;
    for (uint32_t i = begin; i < end; ++i) bucket.emplace_back(cells_[i], numbers_[i]);
    std::ranges::sort(bucket, {}, [](const auto& entry) { return entry.first.vertices; });
    for (uint32_t i = begin; i < end; ++i) std::tie(cells_[i], numbers_[i]) = bucket[i - begin];
}

std::vector<Cell> CellSorter::finish() {
    std::vector<uint32_t> places(cells_.size());
    for (size_t v = 0; v + 1 < begins_.size(); ++v) sort_bucket(begins_[v], begins_[v + 1]);
    for (uint32_t i = 0; i < cells_.size(); ++i) places[numbers_[i]] = i;
    for (Cell& cell : cells_) {
        for (uint32_t& neighbor : cell.neighbors) {
            if (neighbor != kNoIndex) neighbor = places[neighbor];
        }
    }
    return std::move(cells_);
}

}  // namespace tetralight::detail
