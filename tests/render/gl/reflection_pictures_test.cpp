// SPDX-License-Identifier: Apache-2.0
// Pictures with reflection probes by OpenGL against those by rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/render/gl/gl_pictures.h>
#include <tetralight/render/gl/sphere_mesh.h>
#include <tetralight/render/render_gizmos.h>
#include <tetralight/render/render_scene.h>
#include "tests/reflection/reflection_fixture.h"
#include "tests/support/mapped_wall.h"
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// Edges may fall on another pixel.
constexpr double kEdges = 0.01;
constexpr glm::vec3 kGold(0.9f, 0.7f, 0.3f);
const Camera kCamera = look_at({0, 3, 9}, {0, 1, 0}, 0.9);

RenderSettings small_settings() {
    RenderSettings settings;
    settings.width = 96;
    settings.height = 64;
    settings.samples_per_axis = 1;
    return settings;
}

/// A floor and four balls of metal, from a mirror to rough; the last two move.
Scene balls_on_floor() {
    Scene scene;
    Material floor = test::diffuse(glm::vec3(0.5f));
    floor.roughness = 0.3f;
    test::add_floor(scene, floor, 5.0f);
    for (int i = 0; i < 4; ++i) {
        Material metal;
        metal.base_color = glm::vec4(kGold, 1.0f);
        metal.metallic = 1.0f;
        metal.roughness = static_cast<float>(i) / 3.0f;
        MeshInstance& ball = test::add_mesh(scene, metal, make_sphere_mesh(3));
        const glm::dvec3 place(2.0 * i - 3.0, 1.0, 0.0);
        ball.world_from_mesh = glm::scale(glm::translate(glm::dmat4(1.0), place), glm::dvec3(0.8));
        ball.contributes_gi = i < 2;
    }
    return scene;
}

/// Light that differs from place to place, dark in one corner.
ProbeVolume varied_volume() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 1, 9.0));
    for (size_t i = 0; i < volume.irradiance.size(); ++i) {
        const float x = static_cast<float>(volume.exact_positions[i].x);
        volume.irradiance[i] =
            irradiance_from_radiance(constant_radiance(glm::vec3(0.6f + 0.06f * x)));
    }
    volume.info.ambient = irradiance_from_radiance(constant_radiance({0.2f, 0.3f, 0.5f}));
    return volume;
}

/// Two rooms side by side that fade into each other, one of them turned, and if wanted a sky.
Reflections two_rooms(bool has_sky) {
    std::vector<ReflectionProbe> probes{test::box_probe({-2.5, 2, 0}, {3.5f, 2.5f, 4.0f}, 1.5f),
                                        test::box_probe({2.5, 2, 0}, {3.5f, 2.5f, 4.0f}, 1.5f, 2)};
    const glm::mat3 turn(glm::rotate(glm::mat4(1.0f), 0.3f, glm::vec3(0, 1, 0)));
    probes[0].axes = {turn[0], turn[1], turn[2]};
    probes[1].box_center = {0.25f, 0.0f, -0.5f};
    if (has_sky) probes.emplace_back();
    for (ReflectionProbe& probe : probes)
        probe.irradiance = irradiance_from_radiance(constant_radiance(glm::vec3(0.7f)));
    return test::make_reflections(
        32, 3, probes, [](uint32_t probe, uint32_t level, const glm::vec3& d) {
            const glm::vec3 wave = 0.5f + 0.5f * glm::sin((6.0f - 2.0f * float(level)) * d);
            return (0.5f + 0.5f * static_cast<float>(probe)) * wave;
        });
}

class GlReflections : public testing::Test {
  protected:
    void SetUp() override {
        auto created = OffscreenContext::create();
        if (!created) GTEST_SKIP() << error_text(created.error());
        context_.emplace(std::move(*created));
    }

    [[nodiscard]] SceneLight light(const Scene& scene) const {
        SceneLight light = *make_scene_light(scene, volume_.view(), ProbeLight::AsTheScene);
        light.reflections = reflections_.view();
        return light;
    }

    [[nodiscard]] ImageF draw(const Scene& scene, const SceneLight& light,
                              const Camera& camera = kCamera) const {
        auto renderer = Renderer::make(scene, volume_.view(), light, {.shadow_map_size = 64});
        if (!renderer) {
            ADD_FAILURE() << error_text(renderer.error());
            return {};
        }
        const auto image = renderer->render(camera, small_settings(), {});
        EXPECT_TRUE(image) << error_text(image.error());
        return image ? *image : ImageF{};
    }

    [[nodiscard]] ImageF trace(const Scene& scene, const SceneLight& light,
                               const Camera& camera = kCamera) const {
        const auto shader = SceneShader::make(scene, volume_.view(), light);
        return *ray_traced_pictures(*shader, volume_.view()).radiance(camera, small_settings(), {});
    }

    /// Share of pixels that differ by more than 2 % of the brightest radiance.
    static double difference(const ImageF& a, const ImageF& b) {
        EXPECT_EQ(a.pixels.size(), b.pixels.size());
        if (a.pixels.size() != b.pixels.size()) return 1.0;
        float brightest = 0.0f;
        for (const glm::vec3& p : b.pixels) brightest = std::max({brightest, p.x, p.y, p.z});
        size_t count = 0;
        for (size_t i = 0; i < b.pixels.size(); ++i) {
            const glm::vec3 apart = glm::abs(a.pixels[i] - b.pixels[i]);
            count += !(std::max({apart.x, apart.y, apart.z}) <= 0.02f * brightest);
        }
        return static_cast<double>(count) / static_cast<double>(b.pixels.size());
    }

    std::optional<OffscreenContext> context_;
    ProbeVolume volume_ = varied_volume();
    Reflections reflections_ = two_rooms(true);
};

TEST_F(GlReflections, AgreeWithRaysFromMirrorsToRoughMetal) {
    const Scene scene = balls_on_floor();
    SceneLight with = light(scene), far = with, without = with;
    far.has_box_projection = false;
    without.reflections = {};
    const ImageF picture = draw(scene, with);
    EXPECT_LE(difference(picture, trace(scene, with)), kEdges);
    EXPECT_LE(difference(draw(scene, far), trace(scene, far)), kEdges);
    EXPECT_LE(difference(draw(scene, without), trace(scene, without)), kEdges);
    EXPECT_GT(difference(draw(scene, far), picture), 0.1);
    EXPECT_GT(difference(draw(scene, without), picture), 0.2);
}

TEST_F(GlReflections, AgreeWithRaysInOrthographicPictures) {
    const Scene scene = balls_on_floor();
    Camera camera = kCamera;
    camera.half_height = 3.0;
    const SceneLight lit = light(scene);
    EXPECT_LE(difference(draw(scene, lit, camera), trace(scene, lit, camera)), kEdges);
}

TEST_F(GlReflections, AgreeOutsideAllBoxesWhereTheNearestCounts) {
    reflections_ = two_rooms(false);
    for (ReflectionProbe& probe : reflections_.probes) probe.half_size = glm::vec3(0.5f);
    const Scene scene = balls_on_floor();
    const SceneLight lit = light(scene);
    EXPECT_LE(difference(draw(scene, lit), trace(scene, lit)), kEdges);
}

TEST_F(GlReflections, AgreeFarFromTheWorldsOrigin) {
    const glm::dvec3 far(4e5, -2e5, 3e5);
    Scene scene = balls_on_floor();
    const ImageF near = draw(scene, light(scene));
    for (MeshInstance& instance : scene.instances) {
        instance.world_from_mesh = glm::translate(glm::dmat4(1.0), far) * instance.world_from_mesh;
    }
    volume_.info.world_origin += far;
    for (ReflectionProbe& probe : reflections_.probes) probe.position += far;
    const Camera camera = look_at(far + glm::dvec3(0, 3, 9), far + glm::dvec3(0, 1, 0), 0.9);
    EXPECT_LE(difference(draw(scene, light(scene), camera), near), kEdges);
}

TEST_F(GlReflections, AgreeOnTexturesNormalMapsAndUnlitSurfaces) {
    Scene scene = balls_on_floor();
    Texture factors;  // green: roughness; blue: metallic
    factors.image = {1, 2, {{255, 60, 255, 255}, {255, 255, 0, 255}}};
    scene.textures.push_back(factors);
    Material& floor = scene.materials[0];
    floor.metallic = floor.roughness = 1.0f;
    floor.metallic_roughness_texture.texture = 0;
    test::set_normal_map(scene, floor, {0.2f, -0.3f});
    scene.materials[1].is_unlit = true;
    const SceneLight lit = light(scene);
    // Edges of texels may fall on another pixel, too.
    EXPECT_LE(difference(draw(scene, lit), trace(scene, lit)), 2.5 * kEdges);
}

TEST_F(GlReflections, BallsOfGizmosShowTheirLightAlone) {
    auto pictures = GlPictures::make({}, volume_.view(), light({}));
    ASSERT_TRUE(pictures) << error_text(pictures.error());
    const LightBall ball{{0, 0, 0}, 3.0f, irradiance_from_radiance(constant_radiance({1, 2, 3}))};
    const auto image = pictures->source().radiance(look_at({0, 0, 9}, {0, 0, 0}, 0.3),
                                                   small_settings(), std::span(&ball, 1));
    ASSERT_TRUE(image) << error_text(image.error());
    EXPECT_NEAR(glm::distance(image->pixels[32 * 96 + 48], glm::vec3(1, 2, 3)), 0.0f, 1e-3f);
}

TEST_F(GlReflections, RefusesMoreProbesThanOpenGlHolds) {
    GLint layers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    reflections_.probes.resize(static_cast<size_t>(layers) / 6 + 1);
    auto renderer = Renderer::make({}, volume_.view(), light({}));
    ASSERT_FALSE(renderer);
    EXPECT_EQ(error_text(renderer.error()).find("OpenGL: holds "), 0u)
        << error_text(renderer.error());
}

}  // namespace
}  // namespace tetralight
