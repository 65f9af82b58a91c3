// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/occlusion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// The visibility of lights at probes of a scene.
class Occlusion {
  public:
    explicit Occlusion(const Scene& scene)
        : trace_scene_(*TraceScene::make_static(scene)), tracer_(scene, trace_scene_, {}) {}

    [[nodiscard]] float visibility(const Light& light, const glm::dvec3& position,
                                   uint64_t key = 1) const {
        return light_visibility(tracer_, trace_scene_.render_from_world(light),
                                trace_scene_.render_from_world(position), key);
    }

    [[nodiscard]] glm::vec4 of(const std::vector<Light>& lights, const OcclusionLights& owners,
                               const glm::dvec3& position) const {
        std::vector<Light> trace_scene;
        for (const Light& light : lights)
            trace_scene.push_back(trace_scene_.render_from_world(light));
        return probe_occlusion(tracer_, trace_scene, owners,
                               trace_scene_.render_from_world(position), 1);
    }

    /// Of a texel at `position` that looks up, with places at these offsets.
    [[nodiscard]] glm::vec4 of_texel(const std::vector<Light>& lights,
                                     const OcclusionLights& owners, const glm::dvec3& position,
                                     const std::vector<glm::vec3>& places) const {
        std::vector<Light> moved;
        for (const Light& light : lights) moved.push_back(trace_scene_.render_from_world(light));
        return texel_occlusion(tracer_, moved, owners, trace_scene_.render_from_world(position),
                               {{0, 1, 0}, places}, 1);
    }

  private:
    TraceScene trace_scene_;
    PathTracer tracer_;
};

/// Covers x > 0 at a height of 2, endless but for rays that graze.
Scene half_roof() {
    Scene scene;
    Material black = test::diffuse(glm::vec3(0.0f));
    black.is_double_sided = true;
    test::add_quad(scene, black, {0, 2, -500}, {0, 0, 1000}, {500, 0, 0});
    return scene;
}

Light sun(float half_angle) {
    Light light;
    light.direction = {0, -1, 0};
    light.radius = half_angle;
    return light;
}

Light lamp(glm::vec3 position, float radius = 0.0f) {
    Light light;
    light.type = LightType::Point;
    light.position = position;
    light.radius = radius;
    return light;
}

/// Fraction of a disc of radius 1 on the side x < d of a line.
double disc_share(double d) {
    if (d <= -1.0) return 0.0;
    if (d >= 1.0) return 1.0;
    return 1.0 - (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::numbers::pi;
}

TEST(Occlusion, ProbeInFullShadowOfOneLightSeesAllOfAnother) {
    const Scene scene = half_roof();
    const std::vector<Light> lights{sun(0.0f), lamp({3, 1, 0})};
    const glm::vec4 occlusion =
        Occlusion(scene).of(lights, {kNoIndex, 0, kNoIndex, 1}, {2, 0.5, 0.3});
    EXPECT_EQ(occlusion, glm::vec4(1.0f, 0.0f, 1.0f, 1.0f));
}

TEST(Occlusion, PenumbraOfASunIsThatOfAHalfPlane) {
    // The edge lies at x = 0, 2 m above. From x the disc of the sun, of radius tan a at distance 1,
    // is cut at −x / 2.
    const Scene scene = half_roof();
    const Occlusion occlusion(scene);
    const float half_angle = 0.05f;
    const double radius = std::tan(0.05);
    for (const double x : {-0.2, -0.09, -0.06, -0.02, 0.0, 0.03, 0.07, 0.2}) {
        const double expected = disc_share(-x / 2.0 / radius);
        EXPECT_NEAR(occlusion.visibility(sun(half_angle), {x, 0, 0}), expected, 0.02) << x;
    }
}

TEST(Occlusion, PenumbraOfASphereLightIsThatOfAHalfPlane) {
    // The lamp hangs 4 m above the probe at x = 0, the edge 2 m. Seen along the axis its sphere is
    // a disc of radius r / √(1 − r²/16) at 4 m, which the edge cuts at −2x from its center.
    const Scene scene = half_roof();
    const Occlusion occlusion(scene);
    const double r = 0.3, radius = r / std::sqrt(1.0 - r * r / 16.0);
    for (const double x : {-0.3, -0.1, -0.05, 0.0, 0.08, 0.3}) {
        // The lamp stays above the probe: only the edge moves.
        const Light light = lamp({static_cast<float>(x), 4, 0}, 0.3f);
        const double expected = disc_share(-2.0 * x / radius);
        EXPECT_NEAR(occlusion.visibility(light, {x, 0, 0}), expected, 0.02) << x;
    }
}

TEST(Occlusion, HalfTransparentSurfacesTransmitTheirFraction) {
    // 256 rays: σ = √(0.3 · 0.7 / 256) = 0.029 for each of two layers; their product 0.09 + noise.
    Scene scene;
    Material glass = test::diffuse(glm::vec3(0.5f));
    glass.base_color.a = 0.7f;
    glass.alpha_mode = AlphaMode::Blend;
    test::add_floor(scene, glass, 10.0f, 2.0f);
    const Occlusion once(scene);
    EXPECT_NEAR(once.visibility(sun(0.0f), {0.3, 0, 0.1}), 0.3, 4 * 0.029);
    test::add_floor(scene, glass, 10.0f, 3.0f);
    const Occlusion twice(scene);
    EXPECT_NEAR(twice.visibility(sun(0.0f), {0.3, 0, 0.1}), 0.09, 4 * 0.018);
    scene.materials[0].base_color.a = scene.materials[1].base_color.a = 0.0f;
    EXPECT_EQ(Occlusion(scene).visibility(sun(0.0f), {0.3, 0, 0.1}), 1.0f);
}

TEST(Occlusion, EdgesOfTrianglesAreOneSurface) {
    // Rays straight up through the diagonal of a quad, through corners and through the seam between
    // two meshes.
    Scene scene;
    Material glass = test::diffuse(glm::vec3(0.5f));
    glass.base_color.a = 0.5f;
    glass.alpha_mode = AlphaMode::Blend;
    for (const float x : {-4.0f, 0.0f}) {
        test::add_quad(scene, glass, {x, 2, -2}, {0, 0, 4}, {4, 0, 0});
    }
    const Occlusion occlusion(scene);
    double sum = 0.0;
    int count = 0;
    for (int i = -7; i < 8; ++i) {
        const double z = 0.25 * i;
        for (const double x : {z - 2.0, z + 2.0, -z - 2.0, -z + 2.0, 0.0}) {
            const float visible = occlusion.visibility(sun(0.0f), {x, 0, z}, 7 + count++);
            EXPECT_NEAR(visible, 0.5, 5 * 0.031) << x << ' ' << z;  // σ = √(0.25 / 256)
            sum += static_cast<double>(visible);
        }
    }
    EXPECT_NEAR(sum / count, 0.5, 4 * 0.031 / std::sqrt(count));
}

TEST(Occlusion, CutOutSurfacesOccludeOutsideTheirHoles) {
    Scene scene;
    Texture holes;
    holes.image = {2, 1, {{255, 255, 255, 255}, {255, 255, 255, 0}}};
    holes.wrap_u = TextureWrap::ClampToEdge;
    scene.textures.push_back(holes);
    Material leaves = test::diffuse(glm::vec3(0.5f));
    leaves.base_color_texture.texture = 0;
    leaves.alpha_mode = AlphaMode::Mask;
    test::add_quad(scene, leaves, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});  // u along x
    const Occlusion occlusion(scene);
    EXPECT_EQ(occlusion.visibility(sun(0.0f), {-0.9, 0, 0}), 0.0f);
    EXPECT_EQ(occlusion.visibility(sun(0.0f), {0.9, 0, 0}), 1.0f);
}

TEST(Occlusion, IgnoresRangeAndCone) {
    const Scene scene;
    Light light = lamp({0, 3, 0}, 0.1f);
    light.range = 1.0f;
    EXPECT_EQ(Occlusion(scene).visibility(light, {5, 0, 0}), 1.0f);
    light.type = LightType::Spot;
    light.direction = {0, 1, 0};
    EXPECT_EQ(Occlusion(scene).visibility(light, {5, 0, 0}), 1.0f);
}

TEST(Occlusion, AreaLightsHaveNone) {
    const Scene scene;
    Light light = lamp({0, 3, 0}, 0.1f);
    light.type = LightType::Disc;
    EXPECT_EQ(Occlusion(scene).visibility(light, {0, 0, 0}), 0.0f);
}

TEST(Occlusion, SurfacesBehindTheLightDoNotOccludeIt) {
    const Scene scene = half_roof();
    EXPECT_EQ(Occlusion(scene).visibility(lamp({3, 1.9f, 0}), {3, 0, 0}), 1.0f);
    EXPECT_EQ(Occlusion(scene).visibility(lamp({3, 2.1f, 0}), {3, 0, 0}), 0.0f);
}

TEST(Occlusion, OfATexelIsTheMeanOverItsPlaces) {
    // The roof begins at x = 0: three of four places see the sun.
    const Scene roof = half_roof();
    const Occlusion scene(roof);
    const std::vector<glm::vec3> places{{-0.3f, 0, 0}, {-0.2f, 0, 0}, {-0.1f, 0, 0}, {0.1f, 0, 0}};
    const OcclusionLights owners{0, kNoIndex, kNoIndex, kNoIndex};
    const std::vector<Light> hard{sun(0.0f)};
    EXPECT_EQ(scene.of_texel(hard, owners, {0, 0, 0}, places), glm::vec4(0.75f, 1, 1, 1));
    // At a single place it is that of a probe, ray by ray.
    const std::vector<Light> soft{sun(0.2f)};
    EXPECT_EQ(scene.of_texel(soft, owners, {0.1, 0, 0}, {glm::vec3(0.0f)}),
              scene.of(soft, owners, {0.1, 0, 0}));
    // A penumbra: the mean of the disc's shares.
    double expected = 0.0;
    for (const glm::vec3& place : places) {
        expected += disc_share(-double{place.x} / (2.0 * std::tan(0.2))) / 4.0;
    }
    EXPECT_NEAR(double{scene.of_texel(soft, owners, {0, 0, 0}, places).x}, expected, 0.06);
}

}  // namespace
}  // namespace tetralight
