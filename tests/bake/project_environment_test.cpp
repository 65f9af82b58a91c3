// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/project_environment.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tetralight {
namespace {

TEST(ProjectEnvironment, IsExactForAConstantSky) {
    Environment sky;
    sky.radiance = {1, 2, 3};
    EXPECT_EQ(project_environment(sky), constant_radiance({1, 2, 3}));
}

TEST(ProjectEnvironment, KeepsASingleTexelOfALargeSky) {
    // One texel of radiance 1000, next to the equator of 1024 x 512: its solid angle is
    // 2π/1024 · sin(π/512), and bilinear filtering only spreads it over its neighbors.
    Environment sky;
    sky.radiance = glm::vec3(1.0f);
    sky.image = {1024, 512, std::vector<glm::vec3>(1024 * 512, glm::vec3(0.0f))};
    sky.image.pixels[255 * 1024 + 300] = glm::vec3(1000.0f);
    const double solid_angle = 2.0 * std::numbers::pi / 1024.0 * std::sin(std::numbers::pi / 512.0);
    const double expected = 1000.0 * solid_angle * 0.28209479177387814;
    EXPECT_NEAR(project_environment(sky).coefficients[0].x, expected, 0.01 * expected);
}

}  // namespace
}  // namespace tetralight
