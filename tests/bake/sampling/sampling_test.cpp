// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <set>

#include "tests/support/chi_square.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

using test::chi_square;
using test::chi_square_limit;

TEST(ProbeKey, DiffersBySeedAndByEachCoordinate) {
    const std::set<uint64_t> keys = {probe_key(0, {1, 2, 3}),
                                     probe_key(1, {1, 2, 3}),
                                     probe_key(0, {2, 2, 3}),
                                     probe_key(0, {1, 3, 3}),
                                     probe_key(0, {1, 2, 4}),
                                     probe_key(0, {2, 1, 3}),
                                     probe_key(0, {1, 2, std::nextafter(3.0, 4.0)})};
    EXPECT_EQ(keys.size(), 7u);
}

TEST(ProbeKey, TreatsMinusZeroAsZero) {
    EXPECT_EQ(probe_key(7, {-0.0, -0.0, -0.0}), probe_key(7, {0.0, 0.0, 0.0}));
}

TEST(RandomStream, IsUniform) {
    RandomStream random(1, 2);
    std::array<int, 64> bins{};
    constexpr int kCount = 64 * 1000;
    for (int i = 0; i < kCount; ++i) ++bins[static_cast<size_t>(random.next() * 64.0f)];
    EXPECT_LT(chi_square(bins, kCount / 64.0), chi_square_limit(bins.size()));
}

TEST(RandomStream, FirstValuesOfNeighboringStreamsAreUniform) {
    std::array<int, 64> bins{};
    constexpr int kCount = 64 * 1000;
    for (int i = 0; i < kCount; ++i) {
        ++bins[static_cast<size_t>(RandomStream(5, i).next() * 64.0f)];
    }
    EXPECT_LT(chi_square(bins, kCount / 64.0), chi_square_limit(bins.size()));
}

TEST(RandomStream, PairsFillTheSquareEvenly) {
    RandomStream random(3, 0);
    std::array<int, 64> bins{};
    constexpr int kCount = 64 * 1000;
    for (int i = 0; i < kCount; ++i) {
        const glm::vec2 u = random.next2();
        ++bins[static_cast<size_t>(u.x * 8.0f) * 8 + static_cast<size_t>(u.y * 8.0f)];
    }
    EXPECT_LT(chi_square(bins, kCount / 64.0), chi_square_limit(bins.size()));
}

TEST(RandomStream, StaysBelowOne) {
    RandomStream random(11, 0);
    for (int i = 0; i < 100000; ++i) {
        const float value = random.next();
        ASSERT_GE(value, 0.0f);
        ASSERT_LT(value, 1.0f);
    }
}

TEST(RandomStream, DoesNotDependOnOtherStreams) {
    RandomStream alone(9, 4);
    RandomStream first(9, 3), second(9, 4);
    for (int i = 0; i < 10; ++i) {
        static_cast<void>(first.next());
        EXPECT_EQ(second.next(), alone.next());
    }
}

TEST(SphericalFibonacci, DirectionsAreUnitAndBalanced) {
    glm::dvec3 sum(0.0);
    const auto directions = spherical_fibonacci(1000);
    ASSERT_EQ(directions.size(), 1000u);
    for (const glm::vec3& d : directions) {
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
        sum += glm::dvec3(d);
    }
    EXPECT_LT(glm::length(sum) / 1000.0, 1e-3);
}

TEST(SphericalFibonacci, EveryCapHasItsFractionOfDirections) {
    // Spherical cap discrepancy of this lattice falls like N^(-3/4) (Marques et al. 2013);
    // random directions would miss by √(0.25 / 4096) = 8e-3.
    const auto directions = spherical_fibonacci(4096);
    for (const glm::vec3 axis :
         {glm::vec3(1, 0, 0), glm::vec3(0, 0.6f, 0.8f), glm::vec3(0, 0, 1)}) {
        for (const float height : {-0.5f, 0.0f, 0.7f}) {
            int inside = 0;
            for (const glm::vec3& d : directions) inside += glm::dot(d, axis) > height;
            EXPECT_NEAR(inside / 4096.0, 0.5 * (1.0 - static_cast<double>(height)), 3e-3);
        }
    }
}

TEST(SampleRotation, IsOrthonormalAndKeepsHandedness) {
    RandomStream random(1, 0);
    for (int i = 0; i < 100; ++i) {
        const glm::mat3 r = sample_rotation(random);
        const glm::mat3 identity = glm::transpose(r) * r;
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) {
                EXPECT_NEAR(identity[column][row], column == row ? 1.0f : 0.0f, 1e-6f);
            }
        }
        EXPECT_NEAR(glm::determinant(r), 1.0f, 1e-6f);
    }
}

TEST(SampleRotation, TurnsEveryAxisUniformly) {
    // Archimedes: a uniform direction has uniform coordinates.
    constexpr int kCount = 32 * 1000;
    for (int axis = 0; axis < 3; ++axis) {
        for (int coordinate = 0; coordinate < 3; ++coordinate) {
            std::array<int, 32> bins{};
            for (int i = 0; i < kCount; ++i) {
                RandomStream random(2, i);
                const float value = sample_rotation(random)[axis][coordinate];
                ++bins[std::min<size_t>(31, static_cast<size_t>((value + 1.0f) * 16.0f))];
            }
            EXPECT_LT(chi_square(bins, kCount / 32.0), chi_square_limit(bins.size()))
                << axis << "," << coordinate;
        }
    }
}

TEST(SampleCosineHemisphere, HasTheDensityOfItsPdf) {
    // Rings of cos² θ and sectors of φ that are equal by the density cos θ / π:
    // ∫ cos θ / π dω over φ1..φ2 and θ1..θ2 is (φ2 − φ1)/2π · (cos² θ1 − cos² θ2).
    constexpr int kCount = 64 * 1000;
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, -0.7f, -0.4f));
    const glm::vec3 tangent = glm::normalize(glm::cross(normal, glm::vec3(1, 0, 0)));
    const glm::vec3 bitangent = glm::cross(normal, tangent);
    std::array<int, 64> bins{};
    RandomStream random(4, 0);
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 d = sample_cosine_hemisphere(normal, random.next2());
        const double cosine = glm::dot(d, normal);
        const double turn =
            std::atan2(glm::dot(d, bitangent), glm::dot(d, tangent)) / (2.0 * kPi) + 0.5;
        const auto ring = std::min<size_t>(7, static_cast<size_t>(cosine * cosine * 8.0));
        ++bins[ring * 8 + std::min<size_t>(7, static_cast<size_t>(turn * 8.0))];
    }
    EXPECT_LT(chi_square(bins, kCount / 64.0), chi_square_limit(bins.size()));
}

TEST(SampleCosineHemisphere, StaysUnitAndOnItsSideForEveryNormal) {
    RandomStream random(5, 0);
    for (const glm::vec3& normal : spherical_fibonacci(500)) {
        const glm::vec3 d = sample_cosine_hemisphere(normal, random.next2());
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
        EXPECT_GE(glm::dot(d, normal), -1e-6f);
    }
}

TEST(SampleCosineHemisphere, IsFiniteAtThePoles) {
    // u = (0, 0) is the normal itself; the frame formula divides by 1 + |n.z|.
    for (const glm::vec3 pole : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(0, 0, -0.0f)}) {
        const glm::vec3 normal = pole == glm::vec3(0.0f) ? glm::vec3(1, 0, -0.0f) : pole;
        EXPECT_EQ(sample_cosine_hemisphere(normal, {0.0f, 0.0f}), normal);
    }
}

TEST(SampleCosineHemispherePdf, IntegratesToOne) {
    const glm::vec3 normal = glm::normalize(glm::vec3(1.0f, 2.0f, 3.0f));
    double sum = 0.0;
    for (const glm::vec3& d : spherical_fibonacci(100000)) {
        sum += sample_cosine_hemisphere_pdf(normal, d);
    }
    EXPECT_NEAR(sum * 4.0 * kPi / 100000.0, 1.0, 1e-4);
}

TEST(SampleCone, IsUniformByTheCosine) {
    // Archimedes: rings of equal height have equal solid angles.
    constexpr int kCount = 64 * 1000;
    const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    const glm::vec3 tangent = glm::normalize(glm::cross(axis, glm::vec3(1, 0, 0)));
    const glm::vec3 bitangent = glm::cross(axis, tangent);
    std::array<int, 64> bins{};
    RandomStream random(6, 0);
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 d = sample_cone(axis, 0.2f, random.next2());
        const double height = (glm::dot(d, axis) - 0.2) / 0.8;
        const double turn =
            std::atan2(glm::dot(d, bitangent), glm::dot(d, tangent)) / (2.0 * kPi) + 0.5;
        const auto ring = std::clamp(static_cast<int>(height * 8.0), 0, 7);
        ++bins[static_cast<size_t>(ring * 8 + std::min(7, static_cast<int>(turn * 8.0)))];
    }
    EXPECT_LT(chi_square(bins, kCount / 64.0), chi_square_limit(bins.size()));
    EXPECT_NEAR(sample_cone_pdf(0.2f), 1.0 / (2.0 * kPi * 0.8), 1e-6);
}

TEST(SampleDiscAround, IsUniformByArea) {
    constexpr int kCount = 64 * 1000;
    const glm::vec3 normal(0, 1, 0);
    std::array<int, 64> bins{};
    RandomStream random(7, 0);
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 p = sample_disc_around(normal, random.next2());
        EXPECT_NEAR(p.y, 0.0f, 1e-6f);
        const double turn = std::atan2(p.z, p.x) / (2.0 * kPi) + 0.5;
        const auto ring = std::min(7, static_cast<int>(glm::dot(p, p) * 8.0f));
        ++bins[static_cast<size_t>(ring * 8 + std::min(7, static_cast<int>(turn * 8.0)))];
    }
    EXPECT_LT(chi_square(bins, kCount / 64.0), chi_square_limit(bins.size()));
}

}  // namespace
}  // namespace tetralight
