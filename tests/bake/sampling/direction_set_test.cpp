// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/direction_set.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include <tetralight/bake/sampling/sampling.h>

namespace tetralight {
namespace {

std::vector<glm::vec3> sorted(std::vector<glm::vec3> directions) {
    std::ranges::sort(directions, {}, [](glm::vec3 d) { return std::tuple(d.x, d.y, d.z); });
    return directions;
}

std::vector<glm::vec3> all_of(const DirectionSet& set) {
    std::vector<glm::vec3> directions;
    for (uint32_t i = 0; i < set.size(); ++i) directions.push_back(set[i]);
    return directions;
}

TEST(DirectionSet, HasEachDirectionOfTheLatticeOnce) {
    for (const uint32_t count : {1u, 2u, 16u, 128u, 1000u}) {
        EXPECT_EQ(sorted(all_of(DirectionSet(count))), sorted(spherical_fibonacci(count)));
    }
}

TEST(DirectionSet, NeighborsInOrderAreNeighborsOnTheSphere) {
    constexpr uint32_t kCount = 1024;
    const DirectionSet set(kCount);
    double mean_angle = 0.0;
    for (uint32_t i = 1; i < kCount; ++i) {
        mean_angle += std::acos(glm::clamp(glm::dot(set[i - 1], set[i]), -1.0f, 1.0f)) / kCount;
    }
    // A direction has 4π / 1024 of the sphere, 0.11 across; the lattice's own order steps by 1.5.
    EXPECT_LT(mean_angle, 2.0 * 0.11);
}

TEST(DirectionSet, LargeSetsAreTheLatticeItself) {
    constexpr uint32_t kCount = DirectionSet::kMaxOrderedCount + 1;
    const DirectionSet set(kCount);
    for (const uint32_t i : {0u, 77u, kCount - 1}) {
        EXPECT_EQ(set[i], spherical_fibonacci(i, kCount));
    }
}

}  // namespace
}  // namespace tetralight
