// SPDX-License-Identifier: Apache-2.0
#include "probes/build/detail/hilbert_order.h"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <tuple>

#include "probes/hilbert.h"

namespace tetralight::detail {
namespace {

struct Key {
    uint64_t index;
    glm::dvec3 position;
    uint32_t probe;

    bool operator<(const Key& other) const {
        return std::tie(index, position.x, position.y, position.z) <
               std::tie(other.index, other.position.x, other.position.y, other.position.z);
    }
};

}  // namespace

std::vector<uint32_t> hilbert_order(std::span<const glm::dvec3> positions) {
    if (positions.empty()) return {};
    glm::dvec3 low = positions[0];
    glm::dvec3 high = positions[0];
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const HilbertCube cube = make_hilbert_cube(low, high);
    std::vector<Key> keys;
    keys.reserve(positions.size());
    for (uint32_t i = 0; i < positions.size(); ++i) {
        keys.push_back({cube.index(positions[i]), positions[i], i});
    }
    std::ranges::sort(keys, std::less<>{});
    std::vector<uint32_t> order;
    order.reserve(keys.size());
    for (const Key& key : keys) order.push_back(key.probe);
    return order;
}

}  // namespace tetralight::detail
