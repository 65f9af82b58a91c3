// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/environment.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tetralight {
namespace {

constexpr glm::vec3 kColor(3.0f, 5.0f, 7.0f);

/// A black sky of 9 x 5 texels with one coloured: odd sizes put texel centres on the axes.
Environment sky_with_texel(uint32_t column, uint32_t row) {
    Environment sky;
    sky.radiance = glm::vec3(1.0f);
    sky.image = {9, 5, std::vector<glm::vec3>(45, glm::vec3(0.0f))};
    sky.image.pixels[row * 9 + column] = kColor;
    return sky;
}

/// A sky with one whole column of an 8-wide image coloured, looked up at that column's centre.
glm::vec3 radiance_of_column(uint32_t column, float azimuth, float rotation) {
    Environment sky;
    sky.radiance = glm::vec3(1.0f);
    sky.rotation_radians = rotation;
    sky.image = {8, 1, std::vector<glm::vec3>(8, glm::vec3(0.0f))};
    sky.image.pixels[column] = kColor;
    return environment_radiance(sky, {std::cos(azimuth), 0.0f, std::sin(azimuth)});
}

void expect_near(glm::vec3 actual, glm::vec3 expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-4f);
}

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2.0f;

TEST(EnvironmentRadiance, ConstantSkyIsTheSameEverywhere) {
    const Environment sky{kColor, {}, 0.7f};
    EXPECT_EQ(environment_radiance(sky, {0.0f, 1.0f, 0.0f}), kColor);
    EXPECT_EQ(environment_radiance(sky, {0.6f, 0.0f, -0.8f}), kColor);
}

TEST(EnvironmentRadiance, CenterOfTheImageIsPlusX) {
    expect_near(environment_radiance(sky_with_texel(4, 2), {1.0f, 0.0f, 0.0f}), kColor);
    expect_near(environment_radiance(sky_with_texel(4, 2), {-1.0f, 0.0f, 0.0f}), glm::vec3(0.0f));
}

TEST(EnvironmentRadiance, PlusZIsRightOfTheCenter) {
    // Column 5 of 8 ends at u = 0.75, column 6 begins there: both have half the weight.
    expect_near(radiance_of_column(5, kQuarterTurn, 0.0f), kColor * 0.5f);
    expect_near(radiance_of_column(6, kQuarterTurn, 0.0f), kColor * 0.5f);
}

TEST(EnvironmentRadiance, MinusZIsLeftOfTheCenter) {
    expect_near(radiance_of_column(1, -kQuarterTurn, 0.0f), kColor * 0.5f);
    expect_near(radiance_of_column(2, -kQuarterTurn, 0.0f), kColor * 0.5f);
}

TEST(EnvironmentRadiance, MinusXWrapsAroundTheEdge) {
    expect_near(radiance_of_column(0, 2.0f * kQuarterTurn, 0.0f), kColor * 0.5f);
    expect_near(radiance_of_column(7, 2.0f * kQuarterTurn, 0.0f), kColor * 0.5f);
}

TEST(EnvironmentRadiance, PlusYIsTheTopRow) {
    Environment sky = sky_with_texel(0, 0);
    for (size_t column = 0; column < 9; ++column) sky.image.pixels[column] = kColor;
    expect_near(environment_radiance(sky, {0.0f, 1.0f, 0.0f}), kColor);
    expect_near(environment_radiance(sky, {0.0f, -1.0f, 0.0f}), glm::vec3(0.0f));
}

TEST(EnvironmentRadiance, RotationTurnsPlusXToMinusZ) {
    // Counter-clockwise seen from above: +X goes to -Z, as glm::rotate(angle, +Y) does.
    Environment sky = sky_with_texel(4, 2);
    sky.rotation_radians = kQuarterTurn;
    expect_near(environment_radiance(sky, {0.0f, 0.0f, -1.0f}), kColor);
}

TEST(EnvironmentRadiance, RadianceScalesTheImage) {
    Environment sky = sky_with_texel(4, 2);
    sky.radiance = {2.0f, 0.0f, 1.0f};
    expect_near(environment_radiance(sky, {1.0f, 0.0f, 0.0f}), {6.0f, 0.0f, 7.0f});
}

}  // namespace
}  // namespace tetralight
