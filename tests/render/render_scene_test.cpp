// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/render_scene.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const glm::vec3 kAlbedo(0.8f, 0.4f, 0.2f);

IrradianceSh constant_light(glm::vec3 radiance) {
    return irradiance_from_radiance(constant_radiance(radiance));
}

/// Probes all over [-9, 9]³ with the same radiance from everywhere; another one in the sky.
ProbeVolume constant_volume(glm::vec3 radiance, glm::vec3 sky) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1, 9.0));
    for (IrradianceSh& sh : volume.irradiance) sh = constant_light(radiance);
    volume.info.ambient = constant_light(sky);
    return volume;
}

/// Radiance that leaves the scene towards an eye.
glm::vec3 seen(const Scene& scene, const ProbeVolume& volume, const glm::dvec3& eye,
               const glm::dvec3& target) {
    RenderSettings settings;
    settings.width = settings.height = settings.samples_per_axis = 1;
    const auto image = render_scene(scene, volume.view(), look_at(eye, target, 0.01), settings);
    EXPECT_TRUE(image);
    return image->pixels[0];
}

void expect_near(glm::vec3 actual, glm::vec3 expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-4f);
}

Scene floor_scene(glm::vec3 emission = glm::vec3(0.0f)) {
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo, emission), 5.0f);
    return scene;
}

TEST(RenderScene, SurfaceUnderConstantLightShowsAlbedoTimesRadiance) {
    const ProbeVolume volume = constant_volume({1, 2, 3}, glm::vec3(9.0f));
    expect_near(seen(floor_scene(), volume, {1, 3, 0}, {1, 0, 1}), kAlbedo * glm::vec3(1, 2, 3));
}

TEST(RenderScene, WithoutProbesTheSkyLights) {
    ProbeVolume volume;
    volume.info.ambient = constant_light({1, 2, 3});
    expect_near(seen(floor_scene(), volume, {1, 3, 0}, {1, 0, 1}), kAlbedo * glm::vec3(1, 2, 3));
}

TEST(RenderScene, EmissionIsAdded) {
    const ProbeVolume volume = constant_volume(glm::vec3(1.0f), glm::vec3(0.0f));
    expect_near(seen(floor_scene({5, 6, 7}), volume, {1, 3, 0}, {1, 0, 1}),
                kAlbedo + glm::vec3(5, 6, 7));
}

TEST(RenderScene, ABoxHasTheSameExtentsAtAnyDistanceInOrthographicPictures) {
    // 8 m in 48 pixels: six a metre, and the origin in the middle.
    RenderSettings settings;
    settings.width = 64;
    settings.height = 48;
    settings.samples_per_axis = 1;
    ProbeVolume volume;
    for (const float z : {2.0f, -100.0f}) {
        Scene scene;
        test::add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), test::Facing::Outward,
                      {-1.0f, 0.5f, z}, {1.5f, 2.0f, z + 1.0f});
        Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 1.0);
        camera.half_height = 4.0;
        const auto image = render_scene(scene, volume.view(), camera, settings);
        ASSERT_TRUE(image);
        for (uint32_t row = 0; row < 48; ++row) {
            for (uint32_t column = 0; column < 64; ++column) {
                const bool is_box =
                    column >= 32 - 6 && column < 32 + 9 && row >= 24 - 12 && row < 24 - 3;
                EXPECT_EQ(image->pixels[row * 64 + column], glm::vec3(is_box ? 1.0f : 0.0f))
                    << column << " " << row;
            }
        }
    }
}

TEST(RenderScene, SkyStandsBehind) {
    const ProbeVolume volume = constant_volume(glm::vec3(1.0f), {4, 5, 6});
    expect_near(seen(floor_scene(), volume, {0, 1, 0}, {0, 2, 1}), {4, 5, 6});
}

TEST(RenderScene, MixedAndRealtimeSunsAddTheirDirectTerm) {
    // Straight down on the floor: albedo/π · E on top of the probe light.
    for (const LightMode mode : {LightMode::Mixed, LightMode::Realtime}) {
        ProbeVolume volume = constant_volume(glm::vec3(1.0f), glm::vec3(0.0f));
        Scene lights;
        test::add_sun(lights, mode, glm::vec3(std::numbers::pi_v<float>));
        volume.lights = lights.lights;
        expect_near(seen(floor_scene(), volume, {1, 3, 0}, {1, 0, 1}), 2.0f * kAlbedo);
    }
}

TEST(RenderScene, DiscLightAddsItsDirectTerm) {
    // On the axis of a disc E = π L r² / (r² + d²); here with I = π² and r = d = 1 it is π² / 2.
    ProbeVolume volume = constant_volume(glm::vec3(0.0f), glm::vec3(0.0f));
    constexpr float kPi = std::numbers::pi_v<float>;
    Scene lights;
    Light& disc = test::add_light(lights, LightType::Disc, LightMode::Mixed, glm::vec3(kPi * kPi));
    disc.radius = 1.0f;
    disc.position = {0, 1, 0};
    volume.lights = lights.lights;
    expect_near(seen(floor_scene(), volume, {1, 3, 0}, {0, 0, 0}), kAlbedo * (kPi / 2.0f));
}

TEST(RenderScene, BakedLightIsInTheProbesAlready) {
    ProbeVolume volume = constant_volume(glm::vec3(1.0f), glm::vec3(0.0f));
    Scene lights;
    test::add_sun(lights, LightMode::Baked, glm::vec3(9.0f));
    volume.lights = lights.lights;
    expect_near(seen(floor_scene(), volume, {1, 3, 0}, {1, 0, 1}), kAlbedo);
}

TEST(RenderScene, DirectTermIsShadowedByWhatStandsAndWhatMoves) {
    for (const bool contributes_gi : {false, true}) {
        Scene scene = floor_scene();
        test::add_floor(scene, test::diffuse(kAlbedo), 1.0f, 4.0f).contributes_gi = contributes_gi;
        ProbeVolume volume = constant_volume(glm::vec3(1.0f), glm::vec3(0.0f));
        test::add_sun(scene, LightMode::Mixed, glm::vec3(9.0f));
        volume.lights = scene.lights;
        expect_near(seen(scene, volume, {0, 3, 0.1}, {0, 0, 0}), kAlbedo);
        EXPECT_GT(seen(scene, volume, {3, 3, 0.1}, {3, 0, 0}).x, 2.0f * kAlbedo.x);
    }
}

TEST(RenderScene, PointLightIsRightFarFromTheOrigin) {
    // 1 m over the floor, 1e4 m away: albedo/π · I / 1². Lights are floats there: 1 mm.
    const glm::dvec3 offset(1e4, 0, -1e4);
    Scene scene = floor_scene();
    scene.instances[0].world_from_mesh = glm::translate(glm::dmat4(1.0), offset);
    ProbeVolume volume;
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(std::numbers::pi_v<float>),
                          glm::vec3(offset) + glm::vec3(0, 1, 0));
    volume.lights = scene.lights;
    const glm::vec3 radiance = seen(scene, volume, offset + glm::dvec3(0, 3, 2), offset);
    EXPECT_LT(glm::distance(radiance, kAlbedo), 0.01f);
}

TEST(RenderScene, WhatMovesTakesTheLightOfItsMiddle) {
    // Light that grows along X: a static floor shows it, one that moves has that of its centre.
    ProbeVolume volume = constant_volume(glm::vec3(0.0f), glm::vec3(0.0f));
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        const auto x = static_cast<float>(volume.exact_positions[i].x);
        volume.irradiance[i] = constant_light(glm::vec3(10.0f + x));
    }
    Scene scene = floor_scene();
    expect_near(seen(scene, volume, {2, 3, 0.1}, {2, 0, 0}), 12.0f * kAlbedo);
    scene.instances[0].contributes_gi = false;
    expect_near(seen(scene, volume, {2, 3, 0.1}, {2, 0, 0}), 10.0f * kAlbedo);
}

TEST(RenderScene, BackFacesAreCulledUnlessDoubleSided) {
    const ProbeVolume volume = constant_volume(glm::vec3(1.0f), glm::vec3(7.0f));
    Scene scene = floor_scene();
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.1f)), 5.0f, 2.0f);
    const glm::dvec3 eye(1, 4, 0.1);
    expect_near(seen(scene, volume, eye, {1, 0, 0}), kAlbedo);  // through the roof's back
    scene.materials[1].is_double_sided = true;
    expect_near(seen(scene, volume, eye, {1, 0, 0}), glm::vec3(0.1f));
}

TEST(SceneShader, TellsDistanceAndWhatIsBlocked) {
    const Scene scene = floor_scene();
    const ProbeVolume volume = constant_volume(glm::vec3(1.0f), glm::vec3(0.0f));
    const auto shader = SceneShader::make(scene, volume.view());
    ASSERT_TRUE(shader);
    EXPECT_NEAR(shader->shade({0, 3, 0}, {0, -1, 0})->distance, 3.0f, 1e-5f);
    EXPECT_FALSE(shader->shade({0, 3, 0}, {0, 1, 0}));
    EXPECT_TRUE(shader->occluded({0, 3, 0}, {0, -1, 0}, 3.1f));
    EXPECT_FALSE(shader->occluded({0, 3, 0}, {0, -1, 0}, 2.9f));
}

/// A floor of 8 m that moves, under light that grows along x: 1 in the middle.
Scene moving_floor(LightProbeUsage usage) {
    Scene scene;
    MeshInstance& floor = test::add_floor(scene, test::diffuse(kAlbedo), 4.0f);
    floor.contributes_gi = false;
    floor.node = 0;
    scene.nodes.push_back({"floor", kNoIndex, glm::dmat4(1.0), usage});
    return scene;
}

ProbeVolume growing_volume() {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 8; ++i) {
        positions.emplace_back((i & 1) != 0 ? 5 : -5, (i & 2) != 0 ? 5 : -5, (i & 4) != 0 ? 5 : -5);
    }
    ProbeVolume volume = test::make_lit_volume(std::move(positions));
    for (size_t i = 0; i < volume.irradiance.size(); ++i) {
        const auto x = static_cast<float>(volume.exact_positions[i].x);
        volume.irradiance[i] = constant_light(glm::vec3(1.0f + 0.1f * x));
    }
    return volume;
}

TEST(RenderScene, MoversTakeTheLightOfTheirCentre) {
    const Scene scene = moving_floor(LightProbeUsage::Blend);
    for (const double x : {-3.0, 0.5, 3.0}) {
        expect_near(seen(scene, growing_volume(), {x, 3, 0.1}, {x, 0, 0}), kAlbedo);
    }
}

TEST(RenderScene, MoversTakeTheLightOfTheirAnchor) {
    Scene scene = moving_floor(LightProbeUsage::Blend);
    glm::dmat4 world_from_anchor(1.0);
    world_from_anchor[3] = {2, 1, 0, 1};
    scene.nodes.push_back({"anchor", kNoIndex, world_from_anchor});
    scene.nodes[0].probe_anchor = 1;
    for (const double x : {-3.0, 3.0}) {
        expect_near(seen(scene, growing_volume(), {x, 3, 0.1}, {x, 0, 0}), kAlbedo * 1.2f);
    }
}

TEST(RenderScene, MoversWithoutProbesTakeTheAmbientLight) {
    const Scene scene = moving_floor(LightProbeUsage::Off);
    ProbeVolume volume = growing_volume();
    volume.info.ambient = constant_light(glm::vec3(0.3f));
    expect_near(seen(scene, volume, {3, 3, 0.1}, {3, 0, 0}), kAlbedo * 0.3f);
}

TEST(RenderScene, LargeMoversThatAskForItTakeTheLightOfEachPlace) {
    const Scene scene = moving_floor(LightProbeUsage::ProxyVolume);
    for (const double x : {-3.0, 0.5, 3.0}) {
        expect_near(seen(scene, growing_volume(), {x, 3, 0.1}, {x, 0, 0}),
                    kAlbedo * static_cast<float>(1.0 + 0.1 * x));
    }
}

TEST(RenderScene, ProxyVolumesCanBeLeftOut) {
    const Scene scene = moving_floor(LightProbeUsage::ProxyVolume);
    const ProbeVolume volume = growing_volume();
    EXPECT_EQ(SceneShader::make(scene, volume.view())->proxy_volumes().size(), 1u);
    const auto plain = SceneShader::make(scene, volume.view(), ProbeLight::OnePlace);
    EXPECT_TRUE(plain->proxy_volumes().empty());
    expect_near(plain->shade({3, 3, 0}, {0, -1, 0})->radiance, kAlbedo);
}

}  // namespace
}  // namespace tetralight
