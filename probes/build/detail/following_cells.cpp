// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/following_cells.h>

#include <algorithm>
#include <array>
#include <utility>

namespace tetralight::detail {
namespace {

/// Room for one in so many cells more: a vector doubles, which takes time and memory.
constexpr size_t kSpare = 8;

}  // namespace

/// What one call of `write_changes` does. Slots: indices of DelaunayCells; places: of cells.
struct FollowingCells::Changes {
    std::vector<uint32_t> new_inner, new_hull;        // slots
    std::vector<uint32_t> vacant_inner, vacant_hull;  // places; of the latter some are taken again
    std::vector<uint32_t> to_write;                   // slots
};

/// With the cells that they are neighbors of: places of all of these must be known.
Cell FollowingCells::cell_of(const DelaunayTetrahedra& tetrahedra, uint32_t slot) const {
    const DelaunayCell& source = tetrahedra.cells()[slot];
    Cell cell;
    for (size_t i = 0; i < 4; ++i) {
        cell.vertices[i] = source.vertices[i] - 1;
        cell.neighbors[i] = places_[source.neighbors[i] / 4];
    }
    if (source.is_ghost()) cell.vertices[3] = kNoIndex;
    return cell;
}

void FollowingCells::put(uint32_t slot, uint32_t place) {
    places_[slot] = place;
    slots_[place] = slot;
}

void FollowingCells::write_all(const DelaunayTetrahedra& tetrahedra, std::vector<Cell>& cells) {
    const auto source = tetrahedra.cells();
    places_.assign(source.size(), kNoIndex);
    is_marked_.assign(source.size(), 0);
    written_.clear();
    // Counting sort by the smallest vertex.
    std::vector<uint32_t> begins(size_t{tetrahedra.last_vertex()} + 2, 0);
    inner_count_ = count_ = 0;
    for (const DelaunayCell& cell : source) {
        if (cell.is_free()) continue;
        ++count_;
        if (!cell.is_finite()) continue;
        ++inner_count_;
        ++begins[std::ranges::min(cell.vertices) + 1];
    }
    for (size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    slots_.assign(count_, kNoIndex);
    uint32_t next_hull = inner_count_;
    for (uint32_t slot = 0; slot < source.size(); ++slot) {
        if (source[slot].is_free()) continue;
        put(slot, source[slot].is_finite() ? begins[std::ranges::min(source[slot].vertices)]++
                                           : next_hull++);
    }
    if (count_ > cells.capacity()) cells.reserve(count_ + count_ / kSpare);
    cells.resize(std::max<size_t>(cells.size(), count_));
    for (uint32_t place = 0; place < count_; ++place) {
        cells[place] = cell_of(tetrahedra, slots_[place]);
    }
    fill_end(cells);
}

/// Copies of a hull cell behind the others.
void FollowingCells::fill_end(std::vector<Cell>& cells) const {
    for (size_t place = count_; place < cells.size(); ++place) cells[place] = cells[inner_count_];
}

/// Which changed cells keep their place, need one, or leave one vacant.
void FollowingCells::sort_out(const DelaunayTetrahedra& tetrahedra, Changes& changes) {
    const auto source = tetrahedra.cells();
    places_.resize(source.size(), kNoIndex);
    is_marked_.resize(source.size(), 0);
    for (const uint32_t slot : tetrahedra.changed_cells()) {
        if (std::exchange(is_marked_[slot], 1) != 0) continue;
        const uint32_t place = places_[slot];
        const bool was_there = place != kNoIndex, is_there = !source[slot].is_free();
        const bool was_inner = was_there && place < inner_count_;
        const bool is_inner = source[slot].is_finite();
        if (was_there && is_there && was_inner == is_inner) {
            changes.to_write.push_back(slot);
            continue;
        }
        if (was_there) {
            (was_inner ? changes.vacant_inner : changes.vacant_hull).push_back(place);
            slots_[place] = places_[slot] = kNoIndex;
        }
        if (is_there) (is_inner ? changes.new_inner : changes.new_hull).push_back(slot);
    }
    for (const uint32_t slot : tetrahedra.changed_cells()) is_marked_[slot] = 0;
}

void FollowingCells::move(uint32_t from, uint32_t to, Changes& changes) {
    changes.to_write.push_back(slots_[from]);
    put(std::exchange(slots_[from], kNoIndex), to);
}

/// Inner cells take vacant places, then those of hull cells after them, or close up.
void FollowingCells::place_inner(Changes& changes) {
    for (const uint32_t slot : changes.new_inner) {
        uint32_t place = inner_count_;
        if (!changes.vacant_inner.empty()) {
            place = changes.vacant_inner.back();
            changes.vacant_inner.pop_back();
        } else {
            if (count_ == inner_count_) {
                ++count_;
                slots_.resize(std::max<size_t>(slots_.size(), count_), kNoIndex);
            } else if (const uint32_t displaced = slots_[place]; displaced != kNoIndex) {
                places_[displaced] = kNoIndex;
                changes.new_hull.push_back(displaced);
            }
            ++inner_count_;
        }
        put(slot, place);
        changes.to_write.push_back(slot);
    }
    const auto trim = [&] {
        while (inner_count_ > 0 && slots_[inner_count_ - 1] == kNoIndex) {
            changes.vacant_hull.push_back(--inner_count_);
        }
    };
    trim();
    for (const uint32_t place : changes.vacant_inner) {
        if (place >= inner_count_) continue;
        move(inner_count_ - 1, place, changes);
        trim();
    }
}

void FollowingCells::place_hull(Changes& changes) {
    const auto is_vacant = [&](uint32_t place) {
        return place >= inner_count_ && place < count_ && slots_[place] == kNoIndex;
    };
    auto& vacant = changes.vacant_hull;
    for (const uint32_t slot : changes.new_hull) {
        while (!vacant.empty() && !is_vacant(vacant.back())) vacant.pop_back();
        uint32_t place = count_;
        if (vacant.empty()) {
            ++count_;
            slots_.resize(std::max<size_t>(slots_.size(), count_), kNoIndex);
        } else {
            place = vacant.back();
            vacant.pop_back();
        }
        put(slot, place);
        changes.to_write.push_back(slot);
    }
    const auto trim = [&] {
        while (count_ > inner_count_ && slots_[count_ - 1] == kNoIndex) --count_;
    };
    trim();
    for (const uint32_t place : vacant) {
        if (!is_vacant(place)) continue;
        move(count_ - 1, place, changes);
        trim();
    }
}

void FollowingCells::write_changes(const DelaunayTetrahedra& tetrahedra, std::vector<Cell>& cells) {
    if (tetrahedra.is_made_anew()) return write_all(tetrahedra, cells);
    Changes changes;
    sort_out(tetrahedra, changes);
    place_inner(changes);
    place_hull(changes);
    // What names a cell that has another place now is written too.
    if (count_ > cells.capacity()) cells.reserve(count_ + count_ / kSpare);
    cells.resize(std::max<size_t>(cells.size(), count_));
    written_.clear();
    const auto write = [&](uint32_t slot) {
        if (std::exchange(is_marked_[slot], 1) != 0) return;
        const uint32_t place = places_[slot];
        cells[place] = cell_of(tetrahedra, slot);
        written_.push_back(place);
    };
    for (const uint32_t slot : changes.to_write) {
        write(slot);
        for (const uint32_t neighbor : tetrahedra.cells()[slot].neighbors) write(neighbor / 4);
    }
    for (const uint32_t place : written_) is_marked_[slots_[place]] = 0;
    fill_end(cells);
}

}  // namespace tetralight::detail
