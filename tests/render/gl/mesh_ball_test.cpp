// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/gl_mesh_ball.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/gl/presenter.h>
#include <tetralight/render/gl/sphere_mesh.h>
#include <tetralight/render/render_scene.h>
#include "tests/reflection/reflection_fixture.h"
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"
#include "tests/support/volume_sun.h"

namespace tetralight {
namespace {

RenderSettings small_settings() {
    RenderSettings settings;
    settings.width = 64;
    settings.height = 48;
    settings.samples_per_axis = 2;
    return settings;
}

/// Probes around the origin with light from above that grows along x.
ProbeVolume make_volume() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 1, 9.0));
    for (size_t i = 0; i < volume.irradiance.size(); ++i) {
        RadianceSh light = constant_radiance(
            glm::vec3(1.0f + 0.1f * static_cast<float>(volume.exact_positions[i].x)));
        light.coefficients[1] += glm::vec3(0.5f, 0.4f, 0.3f);
        volume.irradiance[i] = irradiance_from_radiance(light);
    }
    test::add_sun(volume, {0.4f, -1.0f, -0.3f});
    volume.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(0.2f)));
    return volume;
}

class GlMeshBallTest : public testing::Test {
  protected:
    void SetUp() override {
        auto created = OffscreenContext::create();
        if (!created) GTEST_SKIP() << error_text(created.error());
        context_.emplace(std::move(*created));
        camera_ = look_at({1, 3, 14}, {0, 0, 0}, 0.8);
        test::add_floor(scene_, test::diffuse({0.5f, 0.6f, 0.3f}), 8.0f, -6.0f);
    }

    [[nodiscard]] SceneLight light_of(const ProbeVolume& volume) const {
        SceneLight light = *make_scene_light(scene_, volume.view(), ProbeLight::AsTheScene);
        light.reflections = reflections_.view();
        return light;
    }

    Result<GlMeshBall> make(uint32_t count, const ProbeVolume& volume) {
        settings_.instance_count = count;
        return GlMeshBall::make(settings_, scene_, light_of(volume), volume.view(), 512);
    }

    static ImageF draw(GlMeshBall& ball, const Camera& camera, double angle, BallLight light,
                       Specular specular = Specular::Off) {
        const auto status = ball.set_frame(angle, light, specular);
        EXPECT_TRUE(status) << error_text(status.error());
        const SphereInstances instances = ball.sphere_instances();
        const auto image = ball.renderer().render(camera, small_settings(), {&instances, 1});
        EXPECT_TRUE(image) << error_text(image.error());
        return image ? *image : ImageF{};
    }

    static double mean_difference(const ImageF& a, const ImageF& b) {
        EXPECT_EQ(a.pixels.size(), b.pixels.size());
        double sum = 0.0;
        for (size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) {
            sum += static_cast<double>(glm::distance(a.pixels[i], b.pixels[i]));
        }
        return sum / static_cast<double>(a.pixels.size());
    }

    /// Mean difference to the picture by rays.
    double difference_to_rays(const ProbeVolume& volume, BallLight light, Specular specular) {
        auto ball = make(100, volume);
        EXPECT_TRUE(ball) << error_text(ball.error());
        const auto shader = SceneShader::make(scene_, volume.view(), light_of(volume));
        const auto proxy = make_ball_proxy(settings_, volume.view());
        const Mirror mirror(reflections_.view(), true);
        const auto rays =
            render_mesh_ball(make_mesh_ball(settings_), {light, specular, &*proxy, &mirror},
                             &*shader, volume.view(), camera_, small_settings());
        EXPECT_TRUE(rays);
        return mean_difference(draw(*ball, camera_, 0.0, light, specular), rays->image);
    }

    std::optional<OffscreenContext> context_;
    Scene scene_;
    MeshBallSettings settings_;
    Camera camera_;
    Reflections reflections_;
};

// Spheres are triangles here, and their shadows texels: some pixels of their edges differ.

TEST_F(GlMeshBallTest, AgreesWithRaysInEveryProbeLight) {
    ProbeVolume volume = make_volume();
    volume.lights.clear();
    volume.light_states.clear();
    for (const auto light : {BallLight::Probes, BallLight::ProxyVolume, BallLight::Off}) {
        EXPECT_LE(difference_to_rays(volume, light, Specular::Off), 0.02)
            << static_cast<int>(light);
    }
    EXPECT_LE(difference_to_rays(volume, BallLight::Probes, Specular::On), 0.02);
    EXPECT_LE(difference_to_rays(volume, BallLight::ProxyVolume, Specular::On), 0.02);
}

TEST_F(GlMeshBallTest, AgreesWithRaysOnTheSun) {
    EXPECT_LE(difference_to_rays(make_volume(), BallLight::Probes, Specular::On), 0.06);
}

TEST_F(GlMeshBallTest, AgreesWithRaysOnReflections) {
    ProbeVolume volume = make_volume();
    volume.lights.clear();
    volume.light_states.clear();
    const auto probe = test::box_probe({0, 0, 0}, glm::vec3(9.0f), 1.0f);
    reflections_ = test::make_reflections(
        32, 3, {probe, ReflectionProbe{}}, [](uint32_t probe_index, uint32_t, const glm::vec3& d) {
            return 0.5f + static_cast<float>(probe_index) + 0.5f * glm::sin(2.0f * d);
        });
    settings_.instance_size = 0.2;
    EXPECT_LE(difference_to_rays(volume, BallLight::Probes, Specular::On), 0.03);
    auto own = make(100, volume);
    ASSERT_TRUE(own) << error_text(own.error());
    const ImageF before = draw(*own, camera_, 0.0, BallLight::Probes);
    for (const float roughness : {0.0f, 0.5f}) {
        settings_.metal_roughness = roughness;
        EXPECT_LE(difference_to_rays(volume, BallLight::Probes, Specular::Off), 0.03) << roughness;
        auto metal = make(100, volume);
        ASSERT_TRUE(metal) << error_text(metal.error());
        EXPECT_GT(mean_difference(draw(*metal, camera_, 0.0, BallLight::Probes), before), 0.1);
    }
}

TEST_F(GlMeshBallTest, TakesItsLightFromOneBatchQueryInPlace) {
    const ProbeVolume volume = make_volume();
    auto ball = make(1023, volume);
    ASSERT_TRUE(ball);
    ASSERT_TRUE(ball->set_frame(1.0, BallLight::Probes, Specular::Off));
    const auto instances = ball->sphere_instances().instances->begin_write();
    for (size_t i = 0; i < instances.size(); i += 97) {
        const auto view = volume.view();
        const auto expected = interpolate(view, locate(view, ball->positions()[i])).irradiance;
        EXPECT_NEAR(glm::distance(instances[i].light.sha_g, pack_sh(expected).sha_g), 0.0f, 1e-5f);
    }
}

TEST_F(GlMeshBallTest, TurnsWithoutNewLightInAProxyVolume) {
    const ProbeVolume volume = make_volume();
    auto ball = make(50, volume);
    ASSERT_TRUE(ball);
    const ImageF before = draw(*ball, camera_, 0.0, BallLight::ProxyVolume);
    EXPECT_EQ(ball->query_seconds(), 0.0);
    EXPECT_GT(mean_difference(draw(*ball, camera_, 1.0, BallLight::ProxyVolume), before), 0.01);
    EXPECT_LT(mean_difference(draw(*ball, camera_, 2.0 * std::numbers::pi, BallLight::ProxyVolume),
                              before),
              1e-4);
}

TEST_F(GlMeshBallTest, HoldsNoneOneAndMoreThanOneBindingTakes) {
    const ProbeVolume volume = make_volume();
    auto none = make(0, volume);
    ASSERT_TRUE(none) << error_text(none.error());
    const ImageF without = draw(*none, camera_, 0.0, BallLight::Probes);
    auto one = make(1, volume);
    ASSERT_TRUE(one);
    EXPECT_GT(mean_difference(draw(*one, camera_, 0.0, BallLight::Probes), without), 0.0);
    InstanceBuffer buffer(1);
    EXPECT_GT(buffer.range_size(), 100'000u);
}

TEST_F(GlMeshBallTest, HoldsVolumesWithoutProbesAndWithoutLight) {
    ProbeVolume empty;
    empty.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(1.0f)));
    ProbeVolume unlit = make_volume();
    unlit.irradiance.clear();
    for (const ProbeVolume* volume : {&empty, &unlit}) {
        auto ball = make(20, *volume);
        ASSERT_TRUE(ball) << error_text(ball.error());
        for (const auto light : {BallLight::Probes, BallLight::ProxyVolume}) {
            EXPECT_EQ(draw(*ball, camera_, 0.0, light).pixels.size(), 64u * 48u);
        }
    }
}

TEST(SphereMesh, HasItsVerticesOnTheSphereAndFacesOutward) {
    for (uint32_t i = 0; i < 4; ++i) {
        const Mesh mesh = make_sphere_mesh(i);
        EXPECT_EQ(mesh.indices.size(), 60u << (2 * i));
        EXPECT_EQ(mesh.positions.size(), 2 + mesh.indices.size() / 6);  // Euler
        double area = 0.0;
        for (size_t t = 0; t < mesh.indices.size(); t += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[t]];
            const glm::vec3 normal = glm::cross(mesh.positions[mesh.indices[t + 1]] - a,
                                                mesh.positions[mesh.indices[t + 2]] - a);
            EXPECT_GT(glm::dot(normal, a), 0.0f);
            area += 0.5 * static_cast<double>(glm::length(normal));
        }
        EXPECT_NEAR(area, 4.0 * std::numbers::pi, 4.0 / (1 << (2 * i)));
    }
}

TEST_F(GlMeshBallTest, PresenterShowsWhatDevelopWrites) {
    const ProbeVolume volume = make_volume();
    auto ball = make(100, volume);
    ASSERT_TRUE(ball);
    ASSERT_TRUE(ball->set_frame(0.0, BallLight::Probes, Specular::On));
    const SphereInstances instances = ball->sphere_instances();
    const RenderTarget target(64, 48, 4);
    ASSERT_TRUE(ball->renderer().draw(camera_, target, {&instances, 1}));
    const auto presenter = Presenter::make();
    ASSERT_TRUE(presenter) << error_text(presenter.error());
    GLuint texture = 0, frame = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, 64, 48);
    glCreateFramebuffers(1, &frame);
    const GlTexture owned_texture(texture);
    const GlFramebuffer owned_frame(frame);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, texture, 0);
    presenter->present(target, frame, 64, 48, 1.5f);
    std::vector<std::array<uint8_t, 4>> pixels(64 * 48);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, 64 * 48 * 4, pixels.data());
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    const Image8 expected = develop(target.read(), 1.5f);
    for (size_t row = 0; row < 48; ++row) {
        for (size_t i = 0; i < 64 * 4; ++i) {
            EXPECT_NEAR(pixels[(47 - row) * 64 + i / 4][i % 4],
                        expected.pixels[row * 64 + i / 4][i % 4], 1);
        }
    }
}

}  // namespace
}  // namespace tetralight
