// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/health_balls.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <tetralight/render/render_gizmos.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// One probe of some health, 4 m ahead of the camera.
ProbeVolume one_probe(float validity, float error) {
    ProbeVolume volume = test::make_lit_volume({{0, 0, 0}});
    volume.validity = {validity};
    volume.health.resize(1);
    volume.health[0].standard_error = error;
    return volume;
}

glm::vec3 color(const ProbeVolume& volume, ProbeColor quantity) {
    return health_color(volume.view(), 0, quantity);
}

/// A picture whose probes show their validity.
Image8 drawn(const Scene& scene, const ProbeVolume& volume, const Camera& camera,
             const RenderSettings& settings) {
    GizmoSettings show;
    show.has_probes = true;
    show.ball_radius = 0.5f;
    show.probe_color = ProbeColor::Validity;
    const auto shader = SceneShader::make(scene, volume.view());
    EXPECT_TRUE(shader);
    const auto image =
        render_gizmos(ray_traced_pictures(*shader, volume.view()), volume.view(), camera, settings,
                      make_gizmos(volume.view(), {}, show), show.probe_color);
    EXPECT_TRUE(image);
    return *image;
}

bool is_reddish(glm::vec3 c) {
    return c.r > 0.7f && c.g < 0.3f;
}

bool is_tealish(glm::vec3 c) {
    return c.r < 0.3f && c.b > 0.5f;
}

TEST(HealthBalls, GradeValidityFromRedToTeal) {
    EXPECT_TRUE(is_reddish(color(one_probe(0.0f, 0.0f), ProbeColor::Validity)));
    EXPECT_TRUE(is_tealish(color(one_probe(1.0f, 0.0f), ProbeColor::Validity)));
    const glm::vec3 fair = color(one_probe(0.75f, 0.0f), ProbeColor::Validity);
    EXPECT_GT(fair.r, 0.9f);
    EXPECT_GT(fair.g, 0.7f);
}

TEST(HealthBalls, GradeErrorsByTheirLogarithm) {
    EXPECT_TRUE(is_tealish(color(one_probe(1.0f, 0.001f), ProbeColor::Error)));
    EXPECT_TRUE(is_reddish(color(one_probe(1.0f, 0.1f), ProbeColor::Error)));
    EXPECT_GT(color(one_probe(1.0f, 0.01f), ProbeColor::Error).g, 0.7f);
}

TEST(HealthBalls, AreGreyWhereNothingIsKnown) {
    ProbeVolume volume = one_probe(1.0f, 0.0f);
    EXPECT_EQ(color(volume, ProbeColor::Error), glm::vec3(0.6f));
    volume.health.clear();
    volume.validity.clear();
    EXPECT_EQ(color(volume, ProbeColor::Error), glm::vec3(0.6f));
    EXPECT_EQ(color(volume, ProbeColor::Validity), glm::vec3(0.6f));
}

TEST(HealthBalls, ShowThroughWallsWhereTheyAreBad) {
    Scene scene;
    test::add_quad(scene, test::diffuse(glm::vec3(0.0f)), {-9, -9, 1}, {18, 0, 0}, {0, 18, 0});
    const Camera camera = look_at({0, 0, 4}, {0, 0, 0}, 0.6);
    RenderSettings settings;
    settings.width = settings.height = 9;
    settings.exposure = 1.0f;
    const auto middle = [&](float validity) {
        const ProbeVolume volume = one_probe(validity, 0.0f);
        return drawn(scene, volume, camera, settings).pixels[40];
    };
    EXPECT_EQ(middle(1.0f)[2], 0);  // behind a black wall
    EXPECT_NEAR(middle(0.0f)[0], 0.5 * 255 * 0.85, 4);
}

TEST(HealthBalls, KeepTheirColorsInEveryExposure) {
    const ProbeVolume volume = one_probe(0.0f, 0.0f);
    const Camera camera = look_at({0, 0, 4}, {0, 0, 0}, 0.6);
    for (const float exposure : {0.01f, 100.0f}) {
        RenderSettings settings;
        settings.width = settings.height = 9;
        settings.exposure = exposure;
        const auto middle = drawn(Scene{}, volume, camera, settings).pixels[40];
        EXPECT_NEAR(middle[0], 255 * 0.85, 4);  // seen straight on
        EXPECT_NEAR(middle[1], 255 * 0.13, 4);
    }
}

}  // namespace
}  // namespace tetralight
