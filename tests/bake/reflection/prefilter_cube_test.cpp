// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/prefilter_cube.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/reflection/reflections.h>

namespace tetralight {
namespace {

/// Noise, and a lamp that is a thousand times as bright.
CubeImage contrasty_cube(uint32_t size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 2.0f);
    CubeImage cube{size, {}};
    const glm::vec3 lamp = glm::normalize(glm::vec3(0.3f, 0.9f, 0.2f));
    for (size_t i = 0; i < cube_texel_count(size); ++i) {
        const bool is_lamp = glm::dot(cube_direction(cube.texel(i), size), lamp) > 0.995f;
        cube.texels.push_back(is_lamp ? glm::vec3(1000.0f)
                                      : glm::vec3(uniform(random), uniform(random), 1.0f));
    }
    return cube;
}

glm::dvec3 brute_force(const CubeImage& source, glm::vec3 direction, double roughness) {
    glm::dvec3 light(0.0);
    double sum = 0.0;
    for (size_t i = 0; i < source.texels.size(); ++i) {
        const CubeTexel texel = source.texel(i);
        const double cosine =
            glm::dot(glm::dvec3(direction), glm::dvec3(cube_direction(texel, source.size)));
        const double weight = ggx_lobe(std::min(1.0, cosine), roughness) *
                              cube_solid_angle(texel.x, texel.y, source.size);
        light += weight * glm::dvec3(source.texels[i]);
        sum += weight;
    }
    return light / sum;
}

TEST(PrefilterCube, AgreesWithBruteForce) {
    const CubeImage source = contrasty_cube(64);
    for (const float roughness : {0.25f, 0.5f, 0.75f, 1.0f}) {
        const CubeImage blurred = prefilter_cube(source, 8, roughness);
        double error = 0.0, light = 0.0;
        for (size_t i = 0; i < blurred.texels.size(); ++i) {
            const glm::dvec3 exact =
                brute_force(source, cube_direction(blurred.texel(i), 8), roughness);
            const glm::dvec3 difference = glm::dvec3(blurred.texels[i]) - exact;
            error += glm::dot(difference, difference);
            light += glm::dot(exact, exact);
        }
        EXPECT_LT(std::sqrt(error / light), 0.01) << roughness;
    }
}

TEST(PrefilterCube, ConstantLightStaysConstant) {
    const CubeImage source{32, std::vector<glm::vec3>(cube_texel_count(32), {0.25f, 3.0f, 700.0f})};
    for (const float roughness : {0.0f, 0.1f, 0.5f, 1.0f}) {
        for (const glm::vec3& texel : prefilter_cube(source, 16, roughness).texels) {
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(texel[i] / source.texels[0][i], 1.0f, 1e-5f) << roughness;
        }
    }
}

TEST(PrefilterCube, WithoutRoughnessTexelsAreMeans) {
    const CubeImage source = contrasty_cube(16);
    const CubeImage half = prefilter_cube(source, 8, 0.0f);
    glm::dvec3 light(0.0);
    double solid_angle = 0.0;
    for (const auto& [x, y] : {std::pair(2u, 4u), {3u, 4u}, {2u, 5u}, {3u, 5u}}) {
        const double angle = cube_solid_angle(x, y, 16);
        light += angle * glm::dvec3(source.texels[source.index({3, x, y})]);
        solid_angle += angle;
    }
    const glm::vec3 mean = half.texels[half.index({3, 1, 2})];
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(mean[i], light[i] / solid_angle, 1e-4);
}

/// Half vectors in proportion to D cos θ_h (Walter et al. 2007, "Microfacet Models for Refraction",
/// equation 35), mirrored at the view, weighted by the cosine: the sum of Karis 2013.
glm::dvec3 sampled_lobe(double roughness, double (*light)(double cosine), uint32_t count) {
    const double alpha = roughness * roughness;
    double sum = 0.0, weights = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count;
        const double tan_squared = alpha * alpha * u / (1.0 - u);
        const double cosine = 2.0 / (1.0 + tan_squared) - 1.0;
        if (cosine <= 0.0) continue;
        sum += cosine * light(cosine);
        weights += cosine;
    }
    return {sum / weights, 0.0, 0.0};
}

TEST(GgxLobe, IsWhatImportanceSamplingConvergesTo) {
    const auto light = [](double cosine) { return cosine * cosine * cosine; };
    for (const double roughness : {0.3, 0.6, 1.0}) {
        double sum = 0.0, weights = 0.0;
        constexpr int kSteps = 200'000;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = (i + 0.5) / kSteps;  // uniform in solid angle
            const double weight = ggx_lobe(cosine, roughness);
            sum += weight * light(cosine);
            weights += weight;
        }
        EXPECT_NEAR(sum / weights, sampled_lobe(roughness, light, kSteps).x, 1e-4) << roughness;
    }
}

TEST(PrefilterLevels, HaveHalfTheSizeEachAndTheSameBitsForAnyNumberOfThreads) {
    const auto levels = prefilter_levels(contrasty_cube(64), 1);
    ASSERT_EQ(levels.size(), reflection_level_count(64));
    for (size_t i = 0; i < levels.size(); ++i) EXPECT_EQ(levels[i].size, 64u >> i);
    EXPECT_EQ(levels[0], contrasty_cube(64));
    EXPECT_EQ(levels.back().size, 8u);
    EXPECT_EQ(levels, prefilter_levels(contrasty_cube(64), 2));
}

}  // namespace
}  // namespace tetralight
