// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/serpentine.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace tetralight::detail {
namespace {

int steps_between(const glm::uvec3& a, const glm::uvec3& b) {
    const glm::ivec3 way = glm::ivec3(a) - glm::ivec3(b);
    return std::abs(way.x) + std::abs(way.y) + std::abs(way.z);
}

TEST(Serpentine, VisitsEachPointOnceAndStepsToOneBesideIt) {
    for (const glm::uvec3 size : {glm::uvec3(4, 3, 5), glm::uvec3(1, 8, 8), glm::uvec3(7, 1, 1)}) {
        Serpentine serpentine;
        std::vector<glm::uvec3> path;
        // Twice: also from where the first ended.
        for (int round = 0; round < 2; ++round) {
            std::vector<int> visits(size.x * size.y * size.z, 0);
            const size_t first = path.size();
            serpentine.walk(size, [&](const glm::uvec3& point) {
                path.push_back(point);
                ++visits[(point.z * size.y + point.y) * size.x + point.x];
            });
            EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
            for (size_t i = first + 1; i < path.size(); ++i) {
                ASSERT_EQ(steps_between(path[i - 1], path[i]), 1);
            }
            EXPECT_EQ(path[first].x, path[first == 0 ? 0 : first - 1].x);
        }
    }
}

}  // namespace
}  // namespace tetralight::detail
