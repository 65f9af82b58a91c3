// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/split_sum.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

/// D V n·l of glTF 2.0, appendix B.3.
double gltf_lobe(const glm::dvec3& v, const glm::dvec3& l, const glm::dvec3& h, double alpha) {
    const double square = alpha * alpha, spread = h.z * h.z * (square - 1.0) + 1.0;
    const double d = square / (std::numbers::pi * spread * spread);
    const double masked_v = l.z * std::sqrt(v.z * v.z * (1.0 - square) + square);
    const double masked_l = v.z * std::sqrt(l.z * l.z * (1.0 - square) + square);
    return d * 0.5 / (masked_v + masked_l) * l.z;
}

/// The integral over all directions of light, by a quadrature over half vectors: dl = 4 v·h dh.
glm::dvec2 quadrature(double n_dot_v, double roughness) {
    constexpr int kSteps = 1500;
    const glm::dvec3 v(std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v);
    glm::dvec2 sum(0.0);
    for (int i = 0; i < kSteps; ++i) {
        const double fraction = (i + 0.5) / kSteps;
        const double theta = 0.5 * std::numbers::pi * fraction * fraction;  // dense near the normal
        const double weight = std::numbers::pi * fraction / kSteps * std::sin(theta);
        for (int j = 0; j < kSteps; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / kSteps;  // both sides are the same
            const glm::dvec3 h(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
            const double v_dot_h = glm::dot(v, h);
            const glm::dvec3 l = 2.0 * v_dot_h * h - v;
            if (v_dot_h <= 0.0 || l.z <= 0.0) continue;
            const double fresnel = std::pow(1.0 - v_dot_h, 5.0);
            const double solid_angle = weight * 2.0 * std::numbers::pi / kSteps * 4.0 * v_dot_h;
            sum += gltf_lobe(v, l, h, roughness * roughness) * solid_angle *
                   glm::dvec2(1.0 - fresnel, fresnel);
        }
    }
    return sum;
}

TEST(SplitSum, IsTheIntegralOfGltfsSpecularLobe) {
    for (const float roughness : {0.25f, 0.5f, 1.0f}) {
        for (const float n_dot_v : {0.05f, 0.4f, 1.0f}) {
            const glm::vec2 sum = integrate_split_sum(n_dot_v, roughness, 4096);
            const glm::dvec2 expected = quadrature(n_dot_v, roughness);
            EXPECT_NEAR(sum.x, expected.x, 1e-3) << roughness << ' ' << n_dot_v;
            EXPECT_NEAR(sum.y, expected.y, 1e-3) << roughness << ' ' << n_dot_v;
        }
    }
}

TEST(SplitSum, OfAMirrorIsFresnelsReflectance) {
    for (const float n_dot_v : {0.1f, 0.3f, 0.7f, 1.0f}) {
        const glm::vec2 sum = integrate_split_sum(n_dot_v, 0.0f, 64);
        EXPECT_NEAR(sum.x + sum.y, 1.0f, 1e-4f);  // a white furnace loses nothing
        EXPECT_NEAR(sum.y, std::pow(1.0f - n_dot_v, 5.0f), 1e-3f);
    }
}

TEST(SplitSum, ReflectsNoMoreThanAll) {
    for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) {
            const glm::vec2 sum = integrate_split_sum(0.05f * static_cast<float>(i),
                                                      0.05f * static_cast<float>(j), 256);
            EXPECT_GE(sum.x, 0.0f);
            EXPECT_GE(sum.y, 0.0f);
            EXPECT_LE(sum.x + sum.y, 1.0f + 1e-6f);
        }
    }
}

TEST(SplitSum, ArgumentsOutOfRangeAreClamped) {
    EXPECT_EQ(integrate_split_sum(1.5f, 2.0f, 64), integrate_split_sum(1.0f, 1.0f, 64));
    EXPECT_EQ(integrate_split_sum(-1.0f, -2.0f, 64), integrate_split_sum(0.0f, 0.0f, 64));
    EXPECT_EQ(integrate_split_sum(0.5f, 0.5f, 0), glm::vec2(0.0f));
}

TEST(SplitSumTable, HasItsValuesAtTheCentersOfTexels) {
    const auto table = make_split_sum_table(8, 64);
    ASSERT_EQ(table.size(), 64u);
    EXPECT_EQ(table[3 * 8 + 5], integrate_split_sum(5.5f / 8.0f, 3.5f / 8.0f, 64));
    EXPECT_EQ(sample_split_sum(table, 5.5f / 8.0f, 3.5f / 8.0f), table[3 * 8 + 5]);
    const glm::vec2 between = 0.25f * (table[27] + table[28] + table[35] + table[36]);
    EXPECT_LT(glm::distance(sample_split_sum(table, 0.5f, 0.5f), between), 1e-6f);
}

TEST(SplitSumTable, IsClampedAtItsEdges) {
    const auto table = make_split_sum_table(8, 64);
    EXPECT_EQ(sample_split_sum(table, 0.0f, 0.0f), table.front());
    EXPECT_EQ(sample_split_sum(table, 2.0f, 2.0f), table.back());
    EXPECT_EQ(sample_split_sum(table, std::nanf(""), -1.0f), table.front());
    EXPECT_EQ(sample_split_sum({}, 0.5f, 0.5f), glm::vec2(0.0f));
}

TEST(SplitSumTable, OfDefaultSizeIsNearTheIntegral) {
    const auto table = make_split_sum_table();
    for (const float roughness : {0.1f, 0.45f, 0.9f}) {
        for (const float n_dot_v : {0.1f, 0.5f, 0.95f}) {
            const glm::vec2 exact = integrate_split_sum(n_dot_v, roughness, 4096);
            EXPECT_LT(glm::distance(sample_split_sum(table, n_dot_v, roughness), exact), 0.01f);
        }
    }
}

TEST(SpecularF0, IsThatOfGltf) {
    EXPECT_EQ(specular_f0({0.9f, 0.5f, 0.1f}, 0.0f), glm::vec3(0.04f));
    EXPECT_EQ(specular_f0({0.9f, 0.5f, 0.1f}, 1.0f), glm::vec3(0.9f, 0.5f, 0.1f));
    EXPECT_NEAR(specular_f0(glm::vec3(0.9f), 0.5f).x, 0.47f, 1e-6f);
}

}  // namespace
}  // namespace tetralight
