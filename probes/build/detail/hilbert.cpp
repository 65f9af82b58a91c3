// SPDX-License-Identifier: Apache-2.0
#include "probes/build/detail/hilbert.h"

#include <algorithm>
#include <glm/common.hpp>
#include <tuple>

namespace tetralight::detail {
namespace {

constexpr int kBits = 21;

struct Key {
    uint64_t index;
    glm::dvec3 position;
    uint32_t probe;

    bool operator<(const Key& other) const {
        return std::tie(index, position.x, position.y, position.z) <
               std::tie(other.index, other.position.x, other.position.y, other.position.z);
    }
};

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

std::vector<uint32_t> hilbert_order(std::span<const glm::dvec3> positions) {
    if (positions.empty()) return {};
    glm::dvec3 low = positions[0];
    glm::dvec3 high = positions[0];
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 size = high - low;
    const double longest = std::max({size.x, size.y, size.z});
    const double scale = longest > 0 ? ((1u << kBits) - 1) / longest : 0.0;

    std::vector<Key> keys;
    keys.reserve(positions.size());
    for (uint32_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 p = (positions[i] - low) * scale;
        const auto index = hilbert_index(
            {static_cast<uint32_t>(p.x), static_cast<uint32_t>(p.y), static_cast<uint32_t>(p.z)});
        keys.push_back({index, positions[i], i});
    }
    std::ranges::sort(keys, std::less<>{});
    std::vector<uint32_t> order;
    order.reserve(keys.size());
    for (const Key& key : keys) order.push_back(key.probe);
    return order;
}

}  // namespace tetralight::detail
