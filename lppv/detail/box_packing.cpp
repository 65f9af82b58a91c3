// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/box_packing.h>

#include <algorithm>
#include <array>

#include <tetralight/base/contract.h>

namespace tetralight::detail {
namespace {

bool fits(glm::uvec3 size, glm::uvec3 room) {
    return size.x <= room.x && size.y <= room.y && size.z <= room.z;
}

}  // namespace

BoxPacking::BoxPacking(glm::uvec3 size) : size_(size), free_{{glm::uvec3(0), size}} {}

uint64_t BoxPacking::capacity() const noexcept {
    return Box{glm::uvec3(0), size_}.volume();
}

std::optional<glm::uvec3> BoxPacking::allocate(glm::uvec3 size) {
    TETRALIGHT_ASSERT(size.x > 0 && size.y > 0 && size.z > 0, "a box has a size");
    auto best = free_.end();
    for (auto box = free_.begin(); box != free_.end(); ++box) {
        if (!fits(size, box->size)) continue;
        if (best == free_.end() || box->volume() < best->volume()) best = box;
    }
    if (best == free_.end()) return std::nullopt;
    const Box box = *best;
    *best = free_.back();
    free_.pop_back();
    cut(box, size);
    used_ += Box{box.low, size}.volume();
    return box.low;
}

/// What remains of a box becomes three: a slab across the axis with most room, then what is beside
/// it, so that large pieces stay large.
void BoxPacking::cut(Box box, glm::uvec3 size) {
    std::array<int, 3> axes{0, 1, 2};
    const auto rest = [&](int axis) { return box.size[axis] - size[axis]; };
    std::ranges::stable_sort(axes, [&](int a, int b) { return rest(a) > rest(b); });
    for (const int axis : axes) {
        if (rest(axis) > 0) {
            Box piece = box;
            piece.low[axis] += size[axis];
            piece.size[axis] -= size[axis];
            free_.push_back(piece);
        }
        box.size[axis] = size[axis];
    }
}

/// Whether two boxes share a whole face; then the first becomes both.
bool BoxPacking::join(Box& box, const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        if (box.low[b] != other.low[b] || box.low[c] != other.low[c]) continue;
        if (box.size[b] != other.size[b] || box.size[c] != other.size[c]) continue;
        const bool is_before = other.low[axis] + other.size[axis] == box.low[axis];
        const bool is_behind = box.low[axis] + box.size[axis] == other.low[axis];
        if (!is_before && !is_behind) continue;
        box.low[axis] = std::min(box.low[axis], other.low[axis]);
        box.size[axis] += other.size[axis];
        return true;
    }
    return false;
}

void BoxPacking::release(glm::uvec3 low, glm::uvec3 size) {
    Box box{low, size};
    used_ -= box.volume();
    if (used_ == 0) {
        free_ = {{glm::uvec3(0), size_}};
        return;
    }
    for (size_t i = 0; i < free_.size();) {
        if (!join(box, free_[i])) {
            ++i;
            continue;
        }
        free_[i] = free_.back();
        free_.pop_back();
        i = 0;
    }
    free_.push_back(box);
}

}  // namespace tetralight::detail
