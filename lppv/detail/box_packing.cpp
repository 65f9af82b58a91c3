// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/box_packing.h>

#include <algorithm>
#include <array>

#include <tetralight/base/contract.h>

namespace tetralight::detail {
namespace {

bool fits(glm::uvec3 size, glm::uvec3 space) {
    return size.x <= space.x && size.y <= space.y && size.z <= space.z;
}

}  // namespace

BoxPacking::BoxPacking(glm::uvec3 size) : size_(size), free_{{glm::uvec3(0), size}} {}

uint64_t BoxPacking::capacity() const noexcept {
    return Box{glm::uvec3(0), size_}.volume();
}

std::optional<glm::uvec3> BoxPacking::allocate(glm::uvec3 size) {
    TETRALIGHT_ASSERT(size.x > 0 && size.y > 0 && size.z > 0, "no side of a box is 0");
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
    used_ += Box{box.min, size}.volume();
    return box.min;
}

/// Cuts a box of this size from a free box. The remainder becomes up to three free boxes: first a
/// slab across the axis with most room, so that large boxes stay large.
void BoxPacking::cut(Box box, glm::uvec3 size) {
    std::array<int, 3> axes{0, 1, 2};
    const auto remainder = [&](int axis) { return box.size[axis] - size[axis]; };
    std::ranges::stable_sort(axes, [&](int a, int b) { return remainder(a) > remainder(b); });
    for (const int axis : axes) {
        if (remainder(axis) > 0) {
            Box piece = box;
            piece.min[axis] += size[axis];
            piece.size[axis] -= size[axis];
            free_.push_back(piece);
        }
        box.size[axis] = size[axis];
    }
}

/// Joins two boxes that share a whole face: the first becomes their union. Returns true if they do.
bool BoxPacking::join(Box& box, const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        if (box.min[b] != other.min[b] || box.min[c] != other.min[c]) continue;
        if (box.size[b] != other.size[b] || box.size[c] != other.size[c]) continue;
        const bool is_before = other.min[axis] + other.size[axis] == box.min[axis];
        const bool is_behind = box.min[axis] + box.size[axis] == other.min[axis];
        if (!is_before && !is_behind) continue;
        box.min[axis] = std::min(box.min[axis], other.min[axis]);
        box.size[axis] += other.size[axis];
        return true;
    }
    return false;
}

void BoxPacking::release(glm::uvec3 min, glm::uvec3 size) {
    Box box{min, size};
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
