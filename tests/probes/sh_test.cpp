// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/sh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Midpoint rule in (z, φ), whose cells have equal areas.
std::vector<glm::vec3> sphere_directions(int rows, int columns) {
    std::vector<glm::vec3> directions;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double z = -1.0 + (2.0 * row + 1.0) / rows;
            const double angle = 2.0 * std::numbers::pi * (column + 0.5) / columns;
            const double radius = std::sqrt(1.0 - z * z);
            directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
    }
    return directions;
}

RadianceSh arbitrary_radiance(uint64_t seed) {
    RadianceSh sh;
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<float> value(-1.0f, 1.0f);
    for (glm::vec3& c : sh.coefficients) c = {value(engine), value(engine), value(engine)};
    return sh;
}

TEST(Sh, BasisIsOrthonormal) {
    const auto directions = sphere_directions(400, 800);
    const double weight = 4.0 * std::numbers::pi / static_cast<double>(directions.size());
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (int j = 0; j <= i; ++j) {
            double integral = 0.0;
            for (const glm::vec3& d : directions) {
                integral += weight * static_cast<double>(sh_basis(d)[i]) * sh_basis(d)[j];
            }
            EXPECT_NEAR(integral, i == j ? 1.0 : 0.0, 5e-5) << i << "," << j;
        }
    }
}

TEST(Sh, ConstantRadianceGivesIrradiancePiForEveryNormal) {
    const IrradianceSh irradiance = irradiance_from_radiance(constant_radiance(glm::vec3(1.0f)));
    std::mt19937_64 engine(1);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 e = evaluate_irradiance(irradiance, test::random_direction(engine));
        EXPECT_NEAR(e.x, kPi, 1e-5f);
        EXPECT_NEAR(e.z, kPi, 1e-5f);
    }
}

TEST(Sh, ProjectsConstantRadianceToItsBand0) {
    const auto directions = sphere_directions(64, 64);
    const std::vector<glm::vec3> radiance(directions.size(), glm::vec3(2.0f));
    const RadianceSh sh = project_radiance(directions, radiance);
    EXPECT_NEAR(sh.coefficients[0].x, 2.0f * std::sqrt(4.0f * kPi), 1e-4f);
    for (int i = 1; i < kShCoefficientCount; ++i) EXPECT_NEAR(sh.coefficients[i].x, 0.0f, 2e-3f);
}

TEST(Sh, LinearRadianceGivesTwoThirdsOfItsSlope) {
    // L(ω) = 1 + ω·a. E(n) = π + (2π/3) a·n, because ∫ ω (n·ω)+ dω = 2π/3 n.
    const glm::vec3 a(0.3f, -0.5f, 0.7f);
    const auto directions = sphere_directions(300, 600);
    std::vector<glm::vec3> radiance;
    for (const glm::vec3& d : directions) radiance.push_back(glm::vec3(1.0f + glm::dot(d, a)));
    const IrradianceSh e = irradiance_from_radiance(project_radiance(directions, radiance));
    for (const glm::vec3& n : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        EXPECT_NEAR(evaluate_irradiance(e, n).y, kPi + 2.0f * kPi / 3.0f * glm::dot(a, n), 1e-4f);
    }
}

TEST(Sh, DirectionalLightHasTheLobeOfTheClampedCosine) {
    // Σ A_l (2l+1)/(4π) P_l(cos): 1/4 + 1/2 cos + 5/16 (3 cos² − 1)/2; 17/16 ahead, 1/16 behind.
    const glm::vec3 to_light = glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f));
    const IrradianceSh e =
        irradiance_from_radiance(radiance_from_directional_light(to_light, glm::vec3(1.0f)));
    EXPECT_NEAR(evaluate_irradiance(e, to_light).x, 17.0f / 16.0f, 1e-5f);
    EXPECT_NEAR(evaluate_irradiance(e, -to_light).x, 1.0f / 16.0f, 1e-5f);
}

TEST(Sh, IrradianceAndRadianceConvertBack) {
    const RadianceSh radiance = arbitrary_radiance(3);
    const RadianceSh back = radiance_from_irradiance(irradiance_from_radiance(radiance));
    for (int i = 0; i < kShCoefficientCount; ++i) {
        EXPECT_NEAR(back.coefficients[i].y, radiance.coefficients[i].y, 1e-6f);
    }
}

TEST(Sh, RotationTurnsTheFunctionWithItsLight) {
    std::mt19937_64 engine(5);
    for (int trial = 0; trial < 50; ++trial) {
        const RadianceSh source = arbitrary_radiance(trial);
        const glm::vec3 axis = test::random_direction(engine);
        const glm::mat3 rotation(
            glm::rotate(glm::mat4(1.0f), 0.7f * static_cast<float>(trial), axis));
        const RadianceSh turned = rotate(source, rotation);
        const glm::vec3 d = test::random_direction(engine);
        const glm::vec3 expected = evaluate_radiance(source, d);
        EXPECT_NEAR(glm::distance(evaluate_radiance(turned, rotation * d), expected), 0.0f, 1e-5f);
    }
}

TEST(Sh, ReflectionMirrorsTheFunction) {
    const glm::mat3 mirror({-1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const RadianceSh source = arbitrary_radiance(9);
    const RadianceSh mirrored = rotate(source, mirror);
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const float sign = i == 3 || i == 4 || i == 7 ? -1.0f : 1.0f;  // x, xy, xz
        EXPECT_NEAR(mirrored.coefficients[i].x, sign * source.coefficients[i].x, 1e-6f) << i;
    }
}

}  // namespace
}  // namespace tetralight
