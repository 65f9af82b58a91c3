// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/blocked_fraction.h>

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// The fractions of a ray and of a pencil from (0, 0, 0) towards `to`.
struct Fractions {
    std::optional<float> ray, pencil;
};

Fractions fractions(const Scene& scene, const glm::dvec3& to = {4, 0, 0},
                    const glm::dvec3& from = {0, 0, 0}) {
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    const glm::vec3 begin = traced->render_from_world(from), end = traced->render_from_world(to);
    return {blocked_fraction(*traced, begin, end), blocked_fraction_of_pencil(*traced, begin, end)};
}

/// Adds a wall of 20 × 20 m across the x axis.
void add_wall(Scene& scene, float x, const Material& material) {
    test::add_quad(scene, material, {x, -10, -10}, {0, 20, 0}, {0, 0, 20});
}

Material pane(float alpha) {
    Material material = test::diffuse(glm::vec3(0.5f));
    material.alpha_mode = AlphaMode::Blend;
    material.base_color.a = alpha;
    return material;
}

void expect_both(const Fractions& found, float fraction) {
    ASSERT_TRUE(found.ray && found.pencil);
    EXPECT_NEAR(*found.ray, fraction, 1e-5f);
    EXPECT_NEAR(*found.pencil, fraction, 1e-5f);
}

void expect_free(const Fractions& found) {
    EXPECT_FALSE(found.ray);
    EXPECT_FALSE(found.pencil);
}

TEST(BlockedFraction, IsThatOfAWallFromBothSides) {
    Scene scene;
    add_wall(scene, 1.0f, test::diffuse(glm::vec3(0.5f)));
    expect_both(fractions(scene), 0.25f);
    expect_both(fractions(scene, {0, 0, 0}, {4, 0, 0}), 0.75f);
    expect_free(fractions(scene, {0.9, 0, 0}));
    expect_free(fractions(scene, {4, 0, 0}, {1.1, 0, 0}));
}

TEST(BlockedFraction, OfAnObliqueWallIsExact) {
    Scene scene;
    add_wall(scene, 1.0f, test::diffuse(glm::vec3(0.5f)));
    expect_both(fractions(scene, {3, 4, 2}), 1.0f / 3.0f);
}

TEST(BlockedFraction, OfAProbeOnAWallSeesBothSides) {
    Scene scene;
    add_wall(scene, 0.0f, test::diffuse(glm::vec3(0.5f)));
    expect_free(fractions(scene, {4, 1, 0}));
    expect_free(fractions(scene, {-4, 1, 0}));
}

TEST(BlockedFraction, OfPanesIsWhereHalfOfTheLightIsLost) {
    Scene scene;
    add_wall(scene, 1.0f, pane(0.3f));
    expect_free(fractions(scene));
    add_wall(scene, 2.0f, pane(0.3f));  // 0.49 arrives
    expect_both(fractions(scene), 0.5f);
    Scene dense;
    add_wall(dense, 1.0f, pane(0.6f));
    expect_both(fractions(dense), 0.25f);
}

/// A quad whose texture is opaque but for one column of `period`, repeated many times.
Scene cut_out(uint32_t opaque_columns, uint32_t period) {
    Scene scene;
    Texture& texture = scene.textures.emplace_back();
    texture.image.width = period;
    texture.image.height = 1;
    for (uint32_t column = 0; column < period; ++column) {
        const uint8_t alpha = column < opaque_columns ? 255 : 0;
        texture.image.pixels.push_back({255, 255, 255, alpha});
    }
    Material material = test::diffuse(glm::vec3(0.5f));
    material.alpha_mode = AlphaMode::Mask;
    material.base_color_texture.texture = 0;
    test::add_quad(scene, material, {1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    return scene;
}

TEST(BlockedFraction, OfCutOutsFollowsTheirTexture) {
    Scene solid = cut_out(4, 4), open = cut_out(0, 4);
    expect_both(fractions(solid), 0.25f);
    expect_free(fractions(open));
}

TEST(BlockedFraction, OfAPencilIgnoresWhatIsThinnerThanIt) {
    Scene scene;  // a wire of 4 mm in front of rays that are 2 cm apart there
    test::add_quad(scene, test::diffuse(glm::vec3(0.5f)), {2, -0.002f, -1}, {0, 0.004f, 0},
                   {0, 0, 2});
    const Fractions found = fractions(scene);
    EXPECT_TRUE(found.ray);
    EXPECT_FALSE(found.pencil);
}

TEST(BlockedFraction, OfAPencilSeesPastAHoleThatIsThinnerThanIt) {
    Scene scene;  // two halves of a wall with a gap of 4 mm
    const Material material = test::diffuse(glm::vec3(0.5f));
    test::add_quad(scene, material, {2, 0.002f, -10}, {0, 10, 0}, {0, 0, 20});
    test::add_quad(scene, material, {2, -10.002f, -10}, {0, 10, 0}, {0, 0, 20});
    const Fractions found = fractions(scene);
    EXPECT_FALSE(found.ray);
    ASSERT_TRUE(found.pencil);
    EXPECT_NEAR(*found.pencil, 0.5f, 1e-5f);
}

}  // namespace
}  // namespace tetralight
