// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/distant_light.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include <tetralight/probes/sh.h>
#include "tests/support/random_light.h"

namespace tetralight {
namespace {

DistantLight random_sky(std::mt19937_64& engine) {
    std::uniform_real_distribution<float> value(-1.0f, 1.0f);
    DistantLight light;
    for (glm::vec3& c : light.coefficients) c = {value(engine), value(engine), value(engine)};
    return light;
}

TEST(DistantLight, BasisIsOrthonormal) {
    const auto directions = test::dense_directions();
    std::array<std::array<double, 16>, 16> products{};
    for (const glm::vec3& direction : directions) {
        const auto basis = distant_basis(direction);
        for (size_t i = 0; i < 16; ++i) {
            for (size_t j = 0; j < 16; ++j) {
                products[i][j] += static_cast<double>(basis[i]) * static_cast<double>(basis[j]);
            }
        }
    }
    const double weight = 4.0 * std::numbers::pi / static_cast<double>(directions.size());
    for (size_t i = 0; i < 16; ++i) {
        for (size_t j = 0; j < 16; ++j) {
            EXPECT_NEAR(products[i][j] * weight, i == j ? 1.0 : 0.0, 1e-4) << i << ' ' << j;
        }
    }
}

TEST(DistantLight, BeginsWithTheBasisOfProbes) {
    const glm::vec3 direction = glm::normalize(glm::vec3(1, -2, 3));
    const auto probe = sh_basis(direction);
    const auto distant = distant_basis(direction);
    for (size_t i = 0; i < probe.size(); ++i) EXPECT_EQ(probe[i], distant[i]);
}

TEST(DistantLight, RotationTurnsTheFunction) {
    std::mt19937_64 engine(1);
    for (int round = 0; round < 20; ++round) {
        const DistantLight sky = random_sky(engine);
        const glm::vec3 axis = test::random_direction(engine);
        const glm::mat3 rotation(
            glm::rotate(glm::mat4(1.0f), 0.3f * static_cast<float>(round), axis));
        const DistantLight turned = rotate(sky, rotation);
        const glm::vec3 direction = test::random_direction(engine);
        const glm::vec3 expected = evaluate_radiance(sky, direction);
        EXPECT_LT(glm::distance(evaluate_radiance(turned, rotation * direction), expected), 1e-5f);
    }
}

TEST(DistantLight, AFullTurnIsNoTurn) {
    std::mt19937_64 engine(2);
    const DistantLight sky = random_sky(engine);
    DistantLight turned = sky;
    const glm::mat3 fifth(
        glm::rotate(glm::mat4(1.0f), 0.4f * std::numbers::pi_v<float>, glm::vec3(0, 1, 0)));
    for (int i = 0; i < 5; ++i) turned = rotate(turned, fifth);
    for (size_t i = 0; i < 16; ++i) {
        EXPECT_LT(glm::distance(turned.coefficients[i], sky.coefficients[i]), 2e-6f);
    }
}

TEST(DistantLight, SunIsTheLightOfADirection) {
    const glm::vec3 to_light = glm::normalize(glm::vec3(1, 2, -1));
    const DistantLight sun = distant_sun(to_light, {1, 2, 3});
    const RadianceSh expected = radiance_from_directional_light(to_light, {1, 2, 3});
    for (size_t i = 0; i < 9; ++i) EXPECT_EQ(sun.coefficients[i], expected.coefficients[i]);
}

}  // namespace
}  // namespace tetralight
