// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/directional_light.h>

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

glm::vec3 random_direction(std::mt19937& random) {
    std::uniform_real_distribution<float> z(-1.0f, 1.0f), azimuth(0.0f, 2.0f * kPi);
    const float height = z(random), angle = azimuth(random);
    const float radius = std::sqrt(1.0f - height * height);
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// A unit vector in the hemisphere of another.
glm::vec3 random_above(const glm::vec3& normal, std::mt19937& random) {
    const glm::vec3 direction = random_direction(random);
    return glm::dot(direction, normal) < 0.0f ? -direction : direction;
}

/// A unit vector at an angle to another.
glm::vec3 tilted(const glm::vec3& normal, float angle_radians, std::mt19937& random) {
    const glm::vec3 along = glm::normalize(glm::cross(normal, random_direction(random)));
    return std::cos(angle_radians) * normal + std::sin(angle_radians) * along;
}

/// φ and v of one channel.
struct Light {
    float flux = 0.0f;
    glm::vec3 vector{0.0f};

    void add_small_light(float flux_of_it, const glm::vec3& direction) {
        flux += flux_of_it;
        vector += flux_of_it * direction;
    }

    [[nodiscard]] float on(const glm::vec3& base_normal, const glm::vec3& normal) const {
        return directional_irradiance(flux, vector, base_normal, normal);
    }
};

TEST(DirectionalLight, OfAUniformSkyFollowsTheVisiblePartOfIt) {
    std::mt19937 random(1);
    for (const float angle : {0.0f, 0.3f, 0.8f, 1.2f, 1.5f}) {
        const glm::vec3 base = random_direction(random);
        // Radiance 3 over the hemisphere of the base normal: φ = 2π · 3, v = π · 3 n0.
        const Light sky{6.0f * kPi, 3.0f * kPi * base};
        const float expected = 3.0f * kPi * 0.5f * (1.0f + std::cos(angle));
        EXPECT_NEAR(sky.on(base, tilted(base, angle, random)), expected, 2e-4f * expected);
    }
}

TEST(DirectionalLight, OfASmallLightIsItsCosine) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 base = random_direction(random), to_light = random_above(base, random);
        const glm::vec3 normal = tilted(base, 0.0012f * static_cast<float>(i), random);
        Light light;
        light.add_small_light(5.0f, to_light);
        EXPECT_NEAR(light.on(base, normal), 5.0f * std::max(0.0f, glm::dot(normal, to_light)),
                    5e-5f);
    }
}

TEST(DirectionalLight, OfASmallLightBeforeAUniformSkyIsTheSumOfBoth) {
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 base = random_direction(random), to_light = random_above(base, random);
        const glm::vec3 normal = tilted(base, 0.0012f * static_cast<float>(i), random);
        Light light{2.0f, base};
        light.add_small_light(3.0f, to_light);
        const float expected = 0.5f * (1.0f + glm::dot(normal, base)) +
                               3.0f * std::max(0.0f, glm::dot(normal, to_light));
        EXPECT_NEAR(light.on(base, normal), expected, 2e-3f);
    }
}

/// Light from some hundred directions of the hemisphere of z, brighter to one side.
struct ManyLights {
    std::vector<glm::vec3> directions;
    std::vector<float> fluxes;
    Light sum;
};

ManyLights make_many_lights(std::mt19937& random) {
    ManyLights lights;
    const glm::vec3 bright = random_direction(random);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 direction = random_above({0.0f, 0.0f, 1.0f}, random);
        const float flux = 0.2f + std::max(0.0f, glm::dot(direction, bright));
        lights.directions.push_back(direction);
        lights.fluxes.push_back(flux);
        lights.sum.add_small_light(flux, direction);
    }
    return lights;
}

TEST(DirectionalLight, OfManyLightsIsExactOnTheBaseNormal) {
    std::mt19937 random(4);
    for (int i = 0; i < 100; ++i) {
        const Light light = make_many_lights(random).sum;
        EXPECT_NEAR(light.on({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}), light.vector.z,
                    1e-4f * light.vector.z);
    }
}

TEST(DirectionalLight, OfManyLightsIsCloseToTheirSum) {
    std::mt19937 random(5);
    const glm::vec3 base(0.0f, 0.0f, 1.0f);
    double squared = 0.0, squared_of_linear = 0.0;
    constexpr int kCount = 300;
    for (int i = 0; i < kCount; ++i) {
        const ManyLights lights = make_many_lights(random);
        const glm::vec3 normal = tilted(base, 0.7f, random);
        float sum = 0.0f;
        for (size_t k = 0; k < lights.fluxes.size(); ++k) {
            sum += lights.fluxes[k] * std::max(0.0f, glm::dot(normal, lights.directions[k]));
        }
        squared += std::pow(lights.sum.on(base, normal) / sum - 1.0, 2.0);
        squared_of_linear += std::pow(glm::dot(normal, lights.sum.vector) / sum - 1.0, 2.0);
    }
    // n · v alone takes light away for what lies below the tilted horizon.
    EXPECT_LT(std::sqrt(squared / kCount), 0.08);
    EXPECT_GT(std::sqrt(squared_of_linear / kCount), 0.16);
}

TEST(DirectionalLight, OfGrazingLightIsExactOnTheBaseNormal) {
    // A ring of light near the horizon: v is shorter than that of a uniform sky.
    const Light ring{10.0f, {0.0f, 0.0f, 1.0f}};
    EXPECT_FLOAT_EQ(ring.on({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}), 1.0f);
}

TEST(DirectionalLight, HasNoBrightPointsInRoundedLight) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f);
    for (int i = 0; i < 10000; ++i) {
        // Any v, also longer than φ and behind the surface.
        const Light light{std::abs(any(random)), {any(random), any(random), any(random)}};
        const float lit = light.on(random_direction(random), random_direction(random));
        EXPECT_GE(lit, 0.0f);
        EXPECT_LE(lit, std::max(light.flux, glm::length(light.vector)) * 1.0001f);
    }
}

TEST(DirectionalLight, IsBlackWithoutLightAndFiniteForExtremes) {
    const glm::vec3 base(0.0f, 1.0f, 0.0f), normal(0.6f, 0.8f, 0.0f);
    EXPECT_EQ(directional_irradiance(0.0f, glm::vec3(0.0f), base, normal), 0.0f);
    for (const float flux : {1e-30f, 1e30f}) {
        const float lit =
            directional_irradiance(flux, flux * glm::vec3(0.6f, 0.8f, 0.0f), base, normal);
        EXPECT_NEAR(lit / flux, 1.0f, 1e-4f);
    }
}

TEST(MonoRatio, TimesTheFlatLightIsTheLightOfOneChannel) {
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
        const Light light = make_many_lights(random).sum;
        const glm::vec3 base(0.0f, 0.0f, 1.0f), normal = tilted(base, 0.7f, random);
        const glm::vec3 u =
            mono_vector(glm::vec3(light.flux), {light.vector, light.vector, light.vector});
        const float lit = light.vector.z * mono_ratio(u, base, normal);
        EXPECT_NEAR(lit, light.on(base, normal), 0.01f * light.vector.z);
    }
}

TEST(MonoRatio, IsOneOnTheBaseNormalAndWithoutDirection) {
    const glm::vec3 base(0.0f, 0.0f, 1.0f), normal(0.0f, 0.6f, 0.8f);
    EXPECT_EQ(mono_ratio({0.3f, 0.1f, 0.5f}, base, base), 1.0f);
    EXPECT_EQ(mono_ratio(glm::vec3(0.0f), base, normal), 1.0f);
    EXPECT_LE(mono_ratio({0.0f, 1.0f, 0.0f}, base, normal), 257.0f);
}

TEST(MonoVector, WeighsChannelsByLuminance) {
    const glm::vec3 x(1.0f, 0.0f, 0.0f), y(0.0f, 1.0f, 0.0f), z(0.0f, 0.0f, 1.0f);
    const glm::vec3 u = mono_vector(glm::vec3(2.0f), {x, y, z});
    EXPECT_NEAR(u.x, 0.2126f / 2.0f, 1e-6f);
    EXPECT_NEAR(u.y, 0.7152f / 2.0f, 1e-6f);
    EXPECT_NEAR(u.z, 0.0722f / 2.0f, 1e-6f);
    // Rounding made v longer than φ.
    EXPECT_NEAR(glm::length(mono_vector(glm::vec3(0.5f), {z, z, z})), 1.0f, 1e-6f);
    EXPECT_EQ(mono_vector(glm::vec3(0.0f), {}), glm::vec3(0.0f));
}

}  // namespace
}  // namespace tetralight
