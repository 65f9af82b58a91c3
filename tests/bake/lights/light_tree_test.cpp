// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_tree.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include <tetralight/bake/lights/punctual_lights.h>
#include <tetralight/bake/sampling/sobol.h>
#include "tests/support/chi_square.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// Lights of all kinds, strewn in a box.
std::vector<Light> strewn_lights(uint32_t count, uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<Light> lights(count);
    for (uint32_t i = 0; i < count; ++i) {
        Light& light = lights[i];
        light.type = static_cast<LightType>(1 + i % 4);
        light.position = 5.0f * glm::vec3(uniform(engine), uniform(engine), uniform(engine));
        light.direction = test::random_direction(engine);
        light.tangent = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 0.5f, 0.7f)));
        light.intensity = glm::vec3(std::exp(2.0f * uniform(engine)));
        light.width = light.height = light.radius = 0.3f;
        light.range = i % 3 == 0 ? 4.0f : 0.0f;
        light.falloff = static_cast<LightFalloff>(i % 3 == 0 ? i % 4 : 0);
    }
    return lights;
}

std::vector<LightBounds> bounds_of(const std::vector<Light>& lights) {
    std::vector<LightBounds> bounds;
    for (const Light& light : lights) bounds.push_back(light_bounds_of(light));
    return bounds;
}

/// Shading points among the lights and far away, with and without a normal.
std::vector<ShadingPoint> receivers(uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<ShadingPoint> result;
    for (const glm::dvec3& p : test::random_positions(40, seed, 6.0)) {
        result.push_back({glm::vec3(p), test::random_direction(engine)});
        result.push_back({glm::vec3(p) * 20.0f, glm::vec3(0.0f)});
    }
    return result;
}

TEST(LightTree, ProbabilitiesSumToOneLessTheFailures) {
    const LightTree tree(bounds_of(strewn_lights(300, 1)));
    for (const ShadingPoint& shading_point : receivers(2)) {
        double sum = 0.0;
        for (uint32_t i = 0; i < 300; ++i) sum += tree.probability(shading_point, i);
        EXPECT_LE(sum, 1.0 + 1e-4);
        int found = 0;
        for (uint32_t i = 0; i < 2000; ++i) {
            found += tree.sample(shading_point, (i + 0.5) / 2000.0).has_value();
        }
        EXPECT_NEAR(sum, found / 2000.0, 0.02);
    }
}

TEST(LightTree, SamplesEachLightWithItsProbability) {
    constexpr uint32_t kLights = 100, kDraws = 50000;
    const LightTree tree(bounds_of(strewn_lights(kLights, 3)));
    const ShadingPoint shading_point{{1, 0.5f, -2}, {0, 1, 0}};
    std::vector<int> observed(kLights + 1, 0);
    std::vector<double> expected(kLights + 1, kDraws);
    for (uint32_t i = 0; i < kLights; ++i) {
        expected[i] = tree.probability(shading_point, i) * double{kDraws};
        expected[kLights] -= expected[i];  // none
    }
    expected[kLights] = std::max(0.0, expected[kLights]);
    for (uint32_t i = 0; i < kDraws; ++i) {
        const auto choice = tree.sample(shading_point, Sampler(i, 0).next_double());
        ++observed[choice ? choice->light : kLights];
        if (choice) {
            EXPECT_FLOAT_EQ(choice->probability, tree.probability(shading_point, choice->light));
        }
    }
    EXPECT_TRUE(test::has_frequencies(observed, expected));
}

TEST(LightTree, EveryLightThatCanContributeIsSampled) {
    const std::vector<Light> lights = strewn_lights(400, 4);
    const LightTree tree(bounds_of(lights));
    int contributing = 0;
    for (const ShadingPoint& shading_point : receivers(5)) {
        for (uint32_t i = 0; i < lights.size(); ++i) {
            bool contributes = false;
            for (uint32_t n = 0; n < 16; ++n) {
                const LightSample sample =
                    sample_light(lights[i], shading_point.position, owen_sobol2(n, i));
                const bool is_before = shading_point.normal == glm::vec3(0.0f) ||
                                       glm::dot(sample.to_light, shading_point.normal) > 0.0f;
                contributes |= is_before && sample.irradiance.x > 0.0f;
            }
            if (!contributes) continue;
            ++contributing;
            EXPECT_GT(tree.probability(shading_point, i), 0.0f);
        }
    }
    EXPECT_GT(contributing, 5000);
}

/// A floor tile that shines up and down, and a lamp, each 2 m beside the origin.
LightTree tile_and_lamp() {
    std::vector<LightBounds> lights(2);
    lights[0].min = lights[0].max = {2, 0, 0};
    lights[0].axis = {0, 1, 0};
    lights[0].cos_theta_o = 1.0f;
    lights[0].cos_theta_e = 0.0f;
    lights[0].is_two_sided = true;
    lights[1].min = lights[1].max = {-2, 0, 0};
    lights[0].power = lights[1].power = 1.0f;
    return LightTree(lights);
}

TEST(LightTree, TwoSidedLightsEmitToBothSidesByTheirCosine) {
    const LightTree tree = tile_and_lamp();
    // Right above and below the tile at 2 m, the lamp is √20 m away: 1/4 against 1/20.
    EXPECT_NEAR(tree.probability({{2, 2, 0}}, 0), 5.0 / 6.0, 1e-5);
    EXPECT_NEAR(tree.probability({{2, -2, 0}}, 0), 5.0 / 6.0, 1e-5);
    // 45° off the axis at √8 m; the lamp at √8 m as well.
    const float slanted = std::sqrt(0.5f);
    EXPECT_NEAR(tree.probability({{0, -2, 0}}, 0), slanted / (slanted + 1.0f), 1e-5);
}

TEST(LightTree, NearAndBrightLightsAreSampledMoreOften) {
    std::vector<LightBounds> lamps(2);
    lamps[0].min = lamps[0].max = {1, 0, 0};
    lamps[1].min = lamps[1].max = {-1, 0, 0};
    lamps[0].power = 1.0f;
    lamps[1].power = 3.0f;
    const LightTree tree(lamps);
    EXPECT_NEAR(tree.probability({{0, 0, 0}}, 1), 0.75, 1e-6);
    // 1/1² against 3/3²
    EXPECT_NEAR(tree.probability({{2, 0, 0}}, 1), 0.25, 1e-6);
}

TEST(LightTree, OneLightAndNone) {
    EXPECT_TRUE(LightTree().is_empty());
    EXPECT_FALSE(LightTree().sample({}, 0.5));
    std::vector<LightBounds> lamps(3);
    EXPECT_TRUE(LightTree(lamps).is_empty());
    lamps[1].power = 1.0f;
    const LightTree tree(lamps);
    EXPECT_EQ(tree.sample({}, 0.999)->light, 1u);
    EXPECT_EQ(tree.probability({}, 1), 1.0f);
    EXPECT_EQ(tree.probability({}, 0), 0.0f);
}

TEST(LightTree, ManyLightsInOnePlaceHaveDistinctTrails) {
    std::vector<LightBounds> lamps(1000);
    for (LightBounds& lamp : lamps) lamp.power = 1.0f;
    const LightTree tree(lamps);
    double sum = 0.0;
    for (uint32_t i = 0; i < 1000; ++i) sum += tree.probability({{1, 2, 3}}, i);
    EXPECT_NEAR(sum, 1.0, 1e-4);
}

}  // namespace
}  // namespace tetralight
