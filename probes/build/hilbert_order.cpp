// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/hilbert_order.h>

#include <algorithm>
#include <compare>
#include <glm/common.hpp>
#include <numeric>
#include <tuple>

#include <tetralight/base/box.h>
#include <tetralight/probes/hilbert.h>

namespace tetralight {
namespace {

/// Fewer positions than this are sorted by x, y, z.
constexpr size_t kFew = 8;

struct Key {
    uint64_t index;
    uint32_t probe;

    auto operator<=>(const Key&) const = default;
};

using Positions = std::span<const glm::dvec3>;

void sort_by_coordinates(Positions positions, std::span<uint32_t> order) {
    std::ranges::sort(order, [&](uint32_t a, uint32_t b) {
        const glm::dvec3 &p = positions[a], &q = positions[b];
        return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    });
}

HilbertCube cube_around(Positions positions, std::span<const uint32_t> order) {
    auto bounds = Box<glm::dvec3>::empty();
    for (const uint32_t i : order) bounds = union_of(bounds, positions[i]);
    return make_hilbert_cube(bounds.min, bounds.max);
}

/// The corners of a cube with a size have different indices, so each call deals with fewer.
void sort_along_curve(Positions positions, std::span<uint32_t> order) {
    const HilbertCube cube = cube_around(positions, order);
    if (cube.scale == 0.0) return;  // all equal, and in the order of their numbers
    std::vector<Key> keys;
    keys.reserve(order.size());
    for (const uint32_t i : order) keys.push_back({cube.index(positions[i]), i});
    std::sort(keys.begin(), keys.end());
    for (size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].probe;

    for (size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        while (end < keys.size() && keys[end].index == keys[begin].index) ++end;
        const std::span<uint32_t> same = order.subspan(begin, end - begin);
        if (same.size() > kFew) {
            sort_along_curve(positions, same);
        } else if (same.size() > 1) {
            sort_by_coordinates(positions, same);
        }
    }
}

}  // namespace

std::vector<uint32_t> hilbert_order(Positions positions) {
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!order.empty()) sort_along_curve(positions, order);
    return order;
}

}  // namespace tetralight
