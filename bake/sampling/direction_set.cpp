// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/direction_set.h>

#include <algorithm>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/contract.h>
#include <tetralight/probes/hilbert.h>

namespace tetralight {

DirectionSet::DirectionSet(uint32_t count) : count_(count) {
    TETRALIGHT_ASSERT(count > 0, "count > 0");
    if (count > kMaxOrderedCount) return;
    ordered_ = spherical_fibonacci(count);
    const HilbertCube cube = make_hilbert_cube(glm::dvec3(-1.0), glm::dvec3(1.0));
    // Directions with equal indices would keep their order; none are that close to each other.
    std::ranges::stable_sort(
        ordered_, {}, [&](glm::vec3 direction) { return cube.index(glm::dvec3(direction)); });
}

glm::vec3 DirectionSet::operator[](uint32_t i) const noexcept {
    return ordered_.empty() ? spherical_fibonacci(i, count_) : ordered_[i];
}

}  // namespace tetralight
