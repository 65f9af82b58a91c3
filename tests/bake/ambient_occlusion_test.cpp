// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/ambient_occlusion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// Of a texel that looks up, at places on the x axis.
float openness(const Scene& scene, float distance, const std::vector<float>& places,
               uint64_t key = 1) {
    const TraceScene traced = *TraceScene::make_static(scene);
    std::vector<glm::vec3> origins;
    for (const float x : places) origins.emplace_back(x, 1e-4f, 0.0f);
    return ambient_occlusion(traced, traced.render_from_world(glm::dvec3(0.0)),
                             {{0, 1, 0}, origins}, distance, key);
}

/// A wall at x = 0, endless to all sides, that ends on the ground.
Scene wall(float alpha = 1.0f) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(0.5f));
    material.is_double_sided = true;
    if (alpha < 1.0f) {
        material.alpha_mode = AlphaMode::Blend;
        material.base_color.a = alpha;
    }
    test::add_quad(scene, material, {0, -10, -1000}, {0, 0, 2000}, {0, 1000, 0});
    return scene;
}

/// A wall at distance d is nearer than `distance` in directions (x, y, z) with x > d / distance. By
/// the cosine to the normal these are a segment of the unit disc.
double open_beside_wall(double d, double distance) {
    const double r = d / distance;
    if (r >= 1.0) return 1.0;
    return 1.0 - (std::acos(r) - r * std::sqrt(1.0 - r * r)) / std::numbers::pi;
}

TEST(AmbientOcclusion, OfAPlaneIsOpen) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 10.0f);
    EXPECT_EQ(openness(scene, 5.0f, {0.0f}), 1.0f);
}

TEST(AmbientOcclusion, BesideAWallIsThatOfADiscSegment) {
    const Scene scene = wall();
    for (const float d : {0.05f, 0.3f, 0.7f, 0.95f, 1.5f}) {
        const double expected = open_beside_wall(double{d}, 1.0);
        EXPECT_NEAR(double{openness(scene, 1.0f, {-d})}, expected, 0.015) << d;
    }
}

TEST(AmbientOcclusion, IsTheMeanOverPlaces) {
    const double expected = 0.5 * (open_beside_wall(0.2, 1.0) + open_beside_wall(0.6, 1.0));
    EXPECT_NEAR(double{openness(wall(), 1.0f, {-0.2f, -0.6f})}, expected, 0.02);
}

TEST(AmbientOcclusion, BlendedSurfacesBlockByTheirAlpha) {
    double sum = 0.0;
    constexpr int kTexels = 64;
    for (int key = 0; key < kTexels; ++key)
        sum += double{openness(wall(0.5f), 1.0f, {-0.3f}, static_cast<uint64_t>(key))};
    EXPECT_NEAR(sum / kTexels, 0.5 + 0.5 * open_beside_wall(0.3, 1.0), 0.01);
}

TEST(AmbientOcclusion, InAClosedBoxThereIsNone) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Inward, {-1, 0, -1},
                  {1, 1, 1});
    EXPECT_EQ(openness(scene, 10.0f, {0.0f}), 0.0f);
}

}  // namespace
}  // namespace tetralight
