// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/nearest_valid.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace tetralight::detail {
namespace {

double distance_between(uint32_t a, uint32_t b, glm::uvec3 size, glm::dvec3 spacing) {
    const auto place = [&](uint32_t i) {
        return glm::dvec3(i % size.x, i / size.x % size.y, i / size.x / size.y) * spacing;
    };
    return glm::distance(place(a), place(b));
}

TEST(NearestValid, AgreesWithLookingAtEveryPoint) {
    const glm::uvec3 size(9, 5, 7);
    const uint32_t count = 9 * 5 * 7;
    std::mt19937 engine(1);
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(0.3, 2.0, 0.7)}) {
        for (const uint32_t valid_of_100 : {2u, 30u, 90u}) {
            std::vector<float> validity;
            for (uint32_t i = 0; i < count; ++i) {
                validity.push_back(engine() % 100 < valid_of_100 ? 1.0f : 0.0f);
            }
            validity[17] = 1.0f;
            const auto nearest = nearest_valid(size, spacing, validity, 0.5f);
            for (uint32_t i = 0; i < count; ++i) {
                double best = std::numeric_limits<double>::infinity();
                for (uint32_t j = 0; j < count; ++j) {
                    if (validity[j] == 0.0f) continue;
                    best = std::min(best, distance_between(i, j, size, spacing));
                }
                ASSERT_EQ(validity[nearest[i]], 1.0f);
                ASSERT_NEAR(distance_between(i, nearest[i], size, spacing), best, 1e-9);
                ASSERT_TRUE(validity[i] == 0.0f || nearest[i] == i);
            }
        }
    }
}

TEST(NearestValid, IsNoneWhereNothingIsValid) {
    const std::vector<float> validity(8, 0.1f);
    EXPECT_EQ(nearest_valid({2, 2, 2}, glm::dvec3(0.0), validity, 0.5f),
              std::vector<uint32_t>(8, kNoIndex));
}

TEST(NearestValid, WorksAlongAxesWithoutThickness) {
    const std::vector<float> validity{0.0f, 0.0f, 1.0f, 0.0f};
    EXPECT_EQ(nearest_valid({4, 1, 1}, glm::dvec3(0.0), validity, 0.5f),
              std::vector<uint32_t>(4, 2));
}

}  // namespace
}  // namespace tetralight::detail
