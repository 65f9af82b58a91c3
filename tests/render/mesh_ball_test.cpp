// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/render/mesh_ball.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include <tetralight/reflection/split_sum.h>
#include "tests/reflection/reflection_fixture.h"
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const glm::vec3 kAlbedo(0.8f, 0.4f, 0.2f);

/// A volume without probes: the same radiance everywhere.
ProbeVolume constant_volume(glm::vec3 radiance) {
    ProbeVolume volume;
    volume.info.ambient = irradiance_from_radiance(constant_radiance(radiance));
    return volume;
}

/// What an eye straight above the origin sees in the middle of its picture.
glm::vec3 seen_from_above(const std::vector<BallInstance>& instances, const Scene* scene,
                          const ProbeVolume& volume, double height = 10.0,
                          const BallLighting& lighting = {}) {
    RenderSettings settings;
    settings.width = settings.height = settings.samples_per_axis = 1;
    const Camera camera = look_at({0, height, 0}, {0, 0, 0}, 0.01);
    std::optional<SceneShader> shader;
    if (scene != nullptr) shader.emplace(*SceneShader::make(*scene, volume.view()));
    const auto picture = render_mesh_ball(instances, lighting, shader ? &*shader : nullptr,
                                          volume.view(), camera, settings);
    EXPECT_TRUE(picture) << error_text(picture.error());
    return picture ? picture->image.pixels[0] : glm::vec3(-1.0f);
}

void expect_near(glm::vec3 actual, glm::vec3 expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-4f);
}

/// A sphere that reflects `kAlbedo` diffusely, and mirrors what comes from one side alone.
BallInstance sphere(const glm::dvec3& center, double radius) {
    return {center, radius, kAlbedo / 0.96f, 0.0f, 1.0f};
}

const std::vector<BallInstance> kOneSphere = {sphere({0, 0, 0}, 2.0)};

TEST(MakeMeshBall, PlainSpheresStandWhereColouredOnesDo) {
    MeshBallSettings settings;
    settings.instance_count = 40;
    const auto colored = make_mesh_ball(settings);
    settings.is_plain = true;
    const auto plain = make_mesh_ball(settings);
    ASSERT_EQ(plain.size(), colored.size());
    for (size_t i = 0; i < plain.size(); ++i) {
        EXPECT_EQ(plain[i].center, colored[i].center);
        EXPECT_EQ(plain[i].radius, colored[i].radius);
        EXPECT_EQ(plain[i].color, plain[0].color);
        EXPECT_EQ(plain[i].metallic, 0.0f);
    }
}

TEST(MakeMeshBall, MetalSpheresStandWhereOthersDo) {
    MeshBallSettings settings;
    settings.instance_count = 40;
    const auto own = make_mesh_ball(settings);
    settings.metal_roughness = 0.25f;
    const auto metal = make_mesh_ball(settings);
    ASSERT_EQ(metal.size(), own.size());
    for (size_t i = 0; i < metal.size(); ++i) {
        EXPECT_EQ(metal[i].center, own[i].center);
        EXPECT_EQ(metal[i].color, own[i].color);
        EXPECT_EQ(metal[i].metallic, 1.0f);
        EXPECT_EQ(metal[i].smoothness, 0.75f);
    }
}

TEST(MakeMeshBall, SameSettingsGiveTheSameInstances) {
    MeshBallSettings settings;
    const auto instances = make_mesh_ball(settings);
    EXPECT_EQ(make_mesh_ball(settings), instances);
    settings.seed = 1;
    EXPECT_NE(make_mesh_ball(settings), instances);
}

TEST(MakeMeshBall, GivesAsManyAsAskedForAndFewerAreTheSameOnes) {
    MeshBallSettings settings;
    const auto all = make_mesh_ball(settings);
    EXPECT_EQ(all.size(), 1023u);
    settings.instance_count = 1;
    EXPECT_EQ(make_mesh_ball(settings), std::vector<BallInstance>(all.begin(), all.begin() + 1));
    settings.instance_count = 0;
    EXPECT_TRUE(make_mesh_ball(settings).empty());
}

TEST(MakeMeshBall, InstancesStandInTheBallWithTheSizesThatWereAskedFor) {
    MeshBallSettings settings;
    settings.center = {100, 200, 300};
    for (const BallInstance& instance : make_mesh_ball(settings)) {
        EXPECT_LE(glm::distance(instance.center, settings.center), settings.radius * (1 + 1e-6));
        EXPECT_GE(instance.radius, 0.5 * 0.06 * settings.radius);
        EXPECT_LE(instance.radius, 1.5 * 0.06 * settings.radius);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(instance.color[i], 0.0f);
            EXPECT_LE(instance.color[i], 1.0f);
        }
    }
}

TEST(MakeMeshBall, FillsTheBallEvenly) {
    // Half of the radius is an eighth of the volume: 1023/8 ± σ, σ = √(1023 · 7/64) = 10.6; and the
    // coordinates of a uniform ball have σ = r/√5: their mean 5/√5/√1023 = 0.07. Four of each.
    int inner = 0;
    glm::dvec3 sum(0.0);
    for (const BallInstance& instance : make_mesh_ball({})) {
        inner += glm::length(instance.center) < 2.5;
        sum += instance.center;
    }
    EXPECT_NEAR(inner, 127.9, 42.4);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis] / 1023.0, 0.0, 0.28);
}

TEST(RenderMeshBall, SphereUnderConstantLightShowsItsAlbedo) {
    expect_near(seen_from_above(kOneSphere, nullptr, constant_volume(glm::vec3(1.0f))), kAlbedo);
}

TEST(RenderMeshBall, EachSphereHasTheLightOfItsOwnPlace) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 1, 9.0));
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        const auto x = static_cast<float>(volume.exact_positions[i].x);
        volume.irradiance[i] = irradiance_from_radiance(constant_radiance(glm::vec3(10.0f + x)));
    }
    // The eye looks at the middle of a sphere whose centre is at x = 1.
    const std::vector<BallInstance> instances = {sphere({-6, 0, 0}, 1.0), sphere({1, 0, 0}, 2.0)};
    expect_near(seen_from_above(instances, nullptr, volume), 11.0f * kAlbedo);
}

TEST(RenderMeshBall, MixedSunAddsItsDirectTerm) {
    ProbeVolume volume = constant_volume(glm::vec3(1.0f));
    Scene lights;
    test::add_sun(lights, LightMode::Mixed, glm::vec3(std::numbers::pi_v<float>));
    volume.lights = lights.lights;
    expect_near(seen_from_above(kOneSphere, nullptr, volume), 2.0f * kAlbedo);
    volume.lights[0].mode = LightMode::Baked;
    expect_near(seen_from_above(kOneSphere, nullptr, volume), kAlbedo);
}

TEST(RenderMeshBall, SpheresShadowEachOther) {
    ProbeVolume volume = constant_volume(glm::vec3(1.0f));
    Scene lights;
    test::add_sun(lights, LightMode::Mixed, glm::vec3(9.0f));
    volume.lights = lights.lights;
    auto instances = kOneSphere;
    instances.push_back(sphere({0, 20, 0}, 1.0));  // above the eye
    expect_near(seen_from_above(instances, nullptr, volume), kAlbedo);
}

TEST(RenderMeshBall, SceneShadowsTheSpheresAndHidesThem) {
    ProbeVolume volume = constant_volume(glm::vec3(1.0f));
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5.0f, 20.0f);
    test::add_sun(scene, LightMode::Mixed, glm::vec3(9.0f));
    volume.lights = scene.lights;
    expect_near(seen_from_above(kOneSphere, &scene, volume), kAlbedo);
    volume.lights.clear();
    expect_near(seen_from_above(kOneSphere, &scene, volume, 30.0), glm::vec3(0.5f));
}

TEST(RenderMeshBall, WithoutInstancesShowsWhatIsBehind) {
    expect_near(seen_from_above({}, nullptr, constant_volume({1, 2, 3})), {1, 2, 3});
}

TEST(RenderMeshBall, MirrorsReflectionProbesByFresnelInTheLightOfThePlace) {
    // Light 3 from above, half of what lights the probe.
    ReflectionProbe probe;
    probe.irradiance = irradiance_from_radiance(constant_radiance(glm::vec3(2.0f)));
    const Reflections cube = test::make_reflections(
        8, 1, {probe},
        [](uint32_t, uint32_t, const glm::vec3& d) { return glm::vec3(d.y > 0.7f ? 3.0f : 0.0f); });
    const Mirror mirror(cube.view(), true);
    BallLighting lighting;
    lighting.mirror = &mirror;
    const ProbeVolume volume = constant_volume(glm::vec3(1.0f));
    // A mirror has all of the light, a rough sphere the half.
    for (const float smoothness : {1.0f, 0.25f}) {
        const glm::vec2 terms = sample_split_sum(make_split_sum_table(), 1.0f, 1.0f - smoothness);
        const float light = smoothness == 1.0f ? 3.0f : 1.5f;
        std::vector<BallInstance> spheres{{{0, 0, 0}, 2.0, kAlbedo, 1.0f, smoothness}};
        expect_near(seen_from_above(spheres, nullptr, volume, 10.0, lighting),
                    light * (kAlbedo * terms.x + terms.y));
        spheres[0].metallic = 0.0f;
        expect_near(seen_from_above(spheres, nullptr, volume, 10.0, lighting),
                    0.96f * kAlbedo + light * (0.04f * terms.x + terms.y));
    }
}

}  // namespace
}  // namespace tetralight
