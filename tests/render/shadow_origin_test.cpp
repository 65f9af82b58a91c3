// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/shadow_origin.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include <tetralight/render/image_renderer.h>
#include <tetralight/render/render_scene.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr glm::vec3 kRadii(1.0f, 0.7f, 1.3f);

/// A sphere of few triangles with smooth normals; the mesh is a unit sphere that the instance
/// stretches, turns and moves.
Scene coarse_ball() {
    constexpr uint32_t kSegments = 12, kRings = 6;
    Mesh mesh;
    for (uint32_t ring = 0; ring <= kRings; ++ring) {
        for (uint32_t i = 0; i <= kSegments; ++i) {
            const float polar = kPi * static_cast<float>(ring) / kRings;
            const float around = 2.0f * kPi * static_cast<float>(i) / kSegments;
            mesh.positions.emplace_back(std::sin(polar) * std::sin(around), std::cos(polar),
                                        std::sin(polar) * std::cos(around));
            if (ring == kRings || i == kSegments) continue;
            const uint32_t a = ring * (kSegments + 1) + i, below = a + kSegments + 1;
            if (ring > 0) mesh.indices.insert(mesh.indices.end(), {a, below, a + 1});
            if (ring + 1 < kRings)
                mesh.indices.insert(mesh.indices.end(), {a + 1, below, below + 1});
        }
    }
    mesh.normals = mesh.positions;
    Scene scene;
    MeshInstance& ball = test::add_mesh(scene, test::diffuse(glm::vec3(0.8f)), std::move(mesh));
    ball.world_from_mesh = glm::translate(glm::dmat4(1.0), {3.0, 1.0, -2.0});
    ball.world_from_mesh = glm::rotate(ball.world_from_mesh, 0.6, glm::dvec3(0, 0, 1));
    ball.world_from_mesh = glm::scale(ball.world_from_mesh, glm::dvec3(kRadii));
    return scene;
}

TEST(ShadowOrigin, SmoothBallsAreLitUpToWhereTheirNormalsTurnAway) {
    const Scene scene = coarse_ball();
    ProbeVolume volume;
    Scene lights;
    test::add_sun(lights, LightMode::Mixed, glm::vec3(kPi));
    lights.lights[0].direction = glm::normalize(glm::vec3(1.0f, -0.2f, -0.3f));
    volume.lights = lights.lights;
    volume.light_names = "sun\n";
    const auto shader = SceneShader::make(scene, volume.view());
    ASSERT_TRUE(shader);
    RenderSettings settings;
    settings.width = settings.height = 96;
    settings.samples_per_axis = 1;
    const Camera camera = look_at({3, 2, 3}, {3, 1, -2}, 0.6);
    const auto picture = [&](SurfaceView view) {
        return render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            const auto shaded = shader->shade(origin, direction, view);
            return shaded ? shaded->radiance : glm::vec3(0.0f);
        });
    };
    const ImageF normals = picture(SurfaceView::Normal), direct = picture(SurfaceView::Direct);
    size_t near_edge = 0;
    for (size_t i = 0; i < normals.pixels.size(); ++i) {
        if (normals.pixels[i] == glm::vec3(0.0f)) continue;
        const glm::vec3 normal = 2.0f * normals.pixels[i] - 1.0f;
        const float cosine = std::max(0.0f, -glm::dot(normal, volume.lights[0].direction));
        if (cosine > 0.0f && cosine < 0.2f) ++near_edge;
        EXPECT_NEAR(direct.pixels[i].x, 0.8f * cosine, 1e-4f) << i;
    }
    EXPECT_GT(near_edge, 100u);
}

TEST(ShadowOrigin, FlatTrianglesStartTheirRaysOnThemselves) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 2.0f);
    const auto traced = TraceScene::make(scene, [](const MeshInstance&) { return true; });
    ASSERT_TRUE(traced);
    const auto surface =
        traced->intersect({traced->render_from_world({0.3, 2.0, 0.4}), glm::vec3(0, -1, 0)});
    ASSERT_TRUE(surface);
    const glm::vec3 origin = shadow_origin(scene, *traced, *surface);
    EXPECT_NEAR(glm::distance(origin, surface->position), surface->error_bound, 1e-6f);
}

}  // namespace
}  // namespace tetralight
