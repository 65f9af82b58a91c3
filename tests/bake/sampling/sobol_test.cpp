// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/sobol.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/chi_square.h"

namespace tetralight {
namespace {

/// True if 2^k points have one point in each box of 2^-i by 2^-(k-i), for all i.
void expect_one_point_a_box(uint32_t k, const std::function<glm::vec2(uint32_t)>& point) {
    const uint32_t count = 1u << k;
    for (uint32_t i = 0; i <= k; ++i) {
        std::vector<int> boxes(count, 0);
        for (uint32_t n = 0; n < count; ++n) {
            const glm::vec2 u = point(n);
            const auto column = static_cast<uint32_t>(u.x * static_cast<float>(1u << i));
            const auto row = static_cast<uint32_t>(u.y * static_cast<float>(1u << (k - i)));
            ++boxes[(column << (k - i)) + row];
        }
        EXPECT_EQ(boxes, std::vector<int>(count, 1)) << "2^-" << i;
    }
}

TEST(OwenSobol2, HasOnePointInEachElementaryInterval) {
    for (const uint64_t seed : {uint64_t{0}, uint64_t{0x123456789abcdefu}, ~uint64_t{0}}) {
        for (const uint32_t block : {0u, 1u, 5u}) {
            expect_one_point_a_box(8,
                                   [&](uint32_t n) { return owen_sobol2((block << 8) + n, seed); });
        }
    }
}

TEST(Sampler, EachPairOfDimensionsHasOnePointInEachElementaryInterval) {
    for (uint32_t pair = 0; pair < 20; ++pair) {
        expect_one_point_a_box(7, [pair](uint32_t path) {
            Sampler sampler(77, path);
            for (uint32_t i = 0; i < pair; ++i) static_cast<void>(sampler.next2());
            return sampler.next2();
        });
    }
}

TEST(Sampler, OnePathIsUniformOverKeys) {
    std::array<int, 256> bins{};
    constexpr int kCount = 256 * 400;
    for (int key = 0; key < kCount; ++key) {
        const glm::vec2 u = Sampler(static_cast<uint64_t>(key), 5).next2();
        ++bins[static_cast<size_t>(u.x * 16.0f) * 16 + static_cast<size_t>(u.y * 16.0f)];
    }
    EXPECT_LT(test::chi_square(bins, kCount / 256.0), test::chi_square_limit(bins.size()));
}

TEST(Sampler, ABranchIsIndependentOfItsPath) {
    std::array<int, 256> bins{};
    constexpr int kCount = 256 * 400;
    for (int key = 0; key < kCount; ++key) {
        Sampler sampler(static_cast<uint64_t>(key), 5);
        Sampler branch = sampler.branch();
        ++bins[static_cast<size_t>(sampler.next() * 16.0f) * 16 +
               static_cast<size_t>(branch.next() * 16.0f)];
    }
    EXPECT_LT(test::chi_square(bins, kCount / 256.0), test::chi_square_limit(bins.size()));
}

TEST(Sampler, PairsOfDimensionsAreIndependent) {
    // Padding: which point of one pair meets which point of another is shuffled.
    std::array<int, 256> bins{};
    constexpr int kPaths = 64, kKeys = 2000;
    for (uint32_t key = 0; key < kKeys; ++key) {
        for (uint32_t path = 0; path < kPaths; ++path) {
            Sampler sampler(key, path);
            const glm::vec2 first = sampler.next2();
            const glm::vec2 second = sampler.next2();
            ++bins[static_cast<size_t>(first.x * 16.0f) * 16 +
                   static_cast<size_t>(second.x * 16.0f)];
        }
    }
    constexpr double kExpected = kPaths * kKeys / 256.0;
    EXPECT_LT(test::chi_square(bins, kExpected), test::chi_square_limit(bins.size()));
}

TEST(Sampler, StaysBelowOneAndVaries) {
    Sampler sampler(1, 2);
    glm::vec2 last(-1.0f);
    for (int i = 0; i < 100000; ++i) {
        const glm::vec2 u = sampler.next2();
        ASSERT_TRUE(u.x >= 0.0f && u.x < 1.0f && u.y >= 0.0f && u.y < 1.0f);
        ASSERT_NE(u, last);
        last = u;
    }
}

/// Root of the mean squared error of the mean of `f`, whose integral over the square is 1/2.
template <class Points>
double error_of(Points points) {
    double sum = 0.0;
    constexpr int kTrials = 200, kCount = 256;
    for (int trial = 0; trial < kTrials; ++trial) {
        double inside = 0.0;
        for (uint32_t i = 0; i < kCount; ++i) {
            const glm::vec2 u = points(static_cast<uint64_t>(trial), i);
            inside += u.x + 2.0f * u.y < 1.5f;
        }
        sum += std::pow(inside / kCount - 0.5, 2.0);
    }
    return std::sqrt(sum / kTrials);
}

TEST(Sampler, AnEdgeIsIntegratedFiveTimesBetterThanByRandomNumbers) {
    // Of 256 random points σ = √(0.25 / 256) = 0.031. Only boxes that the edge crosses err: about
    // 2 · 16 of them, each by less than 1/256 · ½: √32 / 512 = 0.011 at worst.
    const double error = error_of([](uint64_t key, uint32_t i) { return Sampler(key, i).next2(); });
    EXPECT_LT(error, 0.031 / 5.0);
}

}  // namespace
}  // namespace tetralight
