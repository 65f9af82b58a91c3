// SPDX-License-Identifier: Apache-2.0
#include "probes/hilbert.h"

#include <algorithm>

namespace tetralight {
namespace {

constexpr int kBits = kHilbertBits;
constexpr double kLargest = (1u << kBits) - 1;

/// Skilling's inverse undo: turns axes into the transposed Hilbert index.
void transpose_from_axes(std::array<uint32_t, 3>& x) {
    for (uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        const uint32_t below = bit - 1;
        for (uint32_t& axis : x) {
            if (axis & bit) {
                x[0] ^= below;
            } else {
                const uint32_t swap = (x[0] ^ axis) & below;
                x[0] ^= swap;
                axis ^= swap;
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    uint32_t gray = 0;
    for (uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        if (x[2] & bit) gray ^= bit - 1;
    }
    for (uint32_t& axis : x) axis ^= gray;
}

}  // namespace

uint64_t hilbert_index(std::array<uint32_t, 3> point) noexcept {
    transpose_from_axes(point);
    uint64_t index = 0;
    for (int bit = kBits - 1; bit >= 0; --bit) {
        for (const uint32_t axis : point) index = index << 1 | (axis >> bit & 1u);
    }
    return index;
}

uint64_t HilbertCube::index(const glm::dvec3& position) const noexcept {
    std::array<uint32_t, 3> point;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = (position[axis] - low[axis]) * scale;
        point[axis] = step > 0.0 ? static_cast<uint32_t>(std::min(step, kLargest)) : 0u;
    }
    return hilbert_index(point);
}

HilbertCube make_hilbert_cube(const glm::dvec3& low, const glm::dvec3& high) noexcept {
    const glm::dvec3 size = high - low;
    const double longest = std::max({size.x, size.y, size.z});
    return {low, longest > 0.0 ? kLargest / longest : 0.0};
}

}  // namespace tetralight
