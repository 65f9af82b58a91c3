// SPDX-License-Identifier: Apache-2.0
// Previews of volumes that hold occlusion and layers: no light counts twice, and no shadow.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/render/mesh_ball.h>
#include <tetralight/render/render_scene.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
const glm::vec3 kAlbedo(0.8f, 0.4f, 0.2f);

/// Probes all over [-9, 9]³ with radiance 1 from everywhere, and a sun of π from above of which
/// they see `occlusion`.
ProbeVolume make_volume(float occlusion, MixedLighting mode = MixedLighting::Shadowmask) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1, 9.0));
    for (IrradianceSh& light : volume.irradiance) {
        light = irradiance_from_radiance(constant_radiance(glm::vec3(1.0f)));
    }
    Scene lights;
    test::add_sun(lights, LightMode::Mixed, glm::vec3(kPi));
    volume.lights = lights.lights;
    volume.light_names = "sun\n";
    volume.light_states = {{mode, 0, kNoIndex, 0}};
    volume.occlusion.assign(50, glm::vec4(occlusion, 1, 1, 1));
    volume.occlusion_lights.assign(50, {0, kNoIndex, kNoIndex, kNoIndex});
    return volume;
}

/// A floor that may move, under a static roof that hides all of it from the sun.
Scene roofed_floor(bool floor_moves) {
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo), 2.0f).contributes_gi = !floor_moves;
    test::add_floor(scene, test::diffuse(kAlbedo), 8.0f, 5.0f);
    return scene;
}

glm::vec3 seen(const Scene& scene, const ProbeVolume& volume) {
    RenderSettings settings;
    settings.width = settings.height = settings.samples_per_axis = 1;
    const auto image =
        render_scene(scene, volume.view(), look_at({1, 3, 0}, {1, 0, 0.5}, 0.01), settings);
    EXPECT_TRUE(image);
    return image->pixels[0];
}

void expect_near(glm::vec3 actual, glm::vec3 expected, float tolerance = 1e-4f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance);
}

TEST(MixedShading, OnMovingThingsProbesShadeInsteadOfRays) {
    // A ray would say 0: that of the roof would be a second shadow.
    expect_near(seen(roofed_floor(true), make_volume(0.25f)), 1.25f * kAlbedo);
    expect_near(seen(roofed_floor(true), make_volume(0.0f)), kAlbedo);
}

TEST(MixedShading, OnStaticThingsRaysShade) {
    expect_near(seen(roofed_floor(false), make_volume(1.0f)), kAlbedo);
    Scene open;
    test::add_floor(open, test::diffuse(kAlbedo), 2.0f);
    expect_near(seen(open, make_volume(0.25f)), 2.0f * kAlbedo);
}

TEST(MixedShading, MovingThingsStillShadowEachOther) {
    Scene scene = roofed_floor(true);
    scene.instances[1].contributes_gi = false;
    expect_near(seen(scene, make_volume(1.0f)), kAlbedo);
}

TEST(MixedShading, WithoutAChannelEverythingShadows) {
    ProbeVolume volume = make_volume(0.25f);
    volume.light_states[0].channel = kNoIndex;
    expect_near(seen(roofed_floor(true), volume), kAlbedo);
}

TEST(MixedShading, SubtractiveLeavesTheMainSunAlone) {
    ProbeVolume volume = make_volume(1.0f, MixedLighting::Subtractive);
    volume.lights.push_back(volume.lights[0]);
    volume.lights[1].intensity *= 0.5f;
    volume.light_names += "moon\n";
    volume.light_states.push_back({MixedLighting::Subtractive, 1, kNoIndex, 0});
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo), 2.0f);
    expect_near(seen(scene, volume), 2.5f * kAlbedo);
    scene.instances[0].contributes_gi = false;
    expect_near(seen(scene, volume), 2.0f * kAlbedo);
}

TEST(MixedShading, LayersDimLightsAndEmission) {
    ProbeVolume volume = make_volume(1.0f);
    volume.layers.resize(3);
    volume.layer_names = "sun\nmaterial:neon\nemission\n";
    volume.layers[0].weight = 0.5f;
    volume.layers[1].weight = 3.0f;
    volume.layers[2].weight = 0.0f;
    volume.light_states[0].layer = 0;
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo, glm::vec3(1.0f)), 2.0f);
    scene.materials[0].name = "neon";
    expect_near(seen(scene, volume), 1.5f * kAlbedo + glm::vec3(3.0f));
    scene.materials[0].name = "lava";
    expect_near(seen(scene, volume), 1.5f * kAlbedo);
    scene.materials[0].bakes_emission = false;
    expect_near(seen(scene, volume), 1.5f * kAlbedo + glm::vec3(1.0f));
}

/// What an eye straight above sees of a sphere at the origin under a static roof.
glm::vec3 sphere_seen(const ProbeVolume& volume, const Scene& scene) {
    const std::vector<BallInstance> instances{{{0, 0, 0}, 0.5, kAlbedo / 0.96f, 0.0f, 1.0f}};
    const auto shader = SceneShader::make(scene, volume.view());
    EXPECT_TRUE(shader);
    RenderSettings settings;
    settings.width = settings.height = settings.samples_per_axis = 1;
    const auto picture = render_mesh_ball(instances, {}, &*shader, volume.view(),
                                          look_at({0, 3, 0}, {0, 0, 0}, 0.01), settings);
    EXPECT_TRUE(picture);
    return picture->image.pixels[0];
}

TEST(MixedShading, SpheresTakeTheOcclusionOfTheirPlace) {
    Scene roof;
    test::add_floor(roof, test::diffuse(kAlbedo), 8.0f, 5.0f);
    expect_near(sphere_seen(make_volume(0.5f), roof), 1.5f * kAlbedo);
    roof.instances[0].contributes_gi = false;  // it moves: a real-time shadow
    expect_near(sphere_seen(make_volume(0.5f), roof), kAlbedo);
}

/// Lightmaps of a scene with this irradiance / π everywhere, of which texels see half of the light
/// of channel 0 and a fifth of their surroundings.
Lightmaps make_maps(const Scene& scene, MixedLighting mode, float light) {
    BakeLightmapsSettings settings;
    settings.bake.sample_count = 1;
    settings.layout.texels_per_meter = 1.0;
    settings.layout.page_size = 64;
    settings.lighting.mixed_lighting = mode;
    settings.ambient_occlusion_distance = 1.0f;
    Lightmaps maps = bake_lightmaps(scene, settings)->lightmaps;
    const uint16_t half = half_from_float(kPi * light / maps.info.scale);
    for (IrradianceTexel& texel : maps.irradiance) texel.rgb = {half, half, half};
    for (ShadowMaskTexel& texel : maps.shadow_mask) texel = {128, 255, 255, 255};
    for (uint8_t& open : maps.ambient_occlusion) open = 51;
    return maps;
}

/// Up to the rounding of halves.
void expect_light(glm::vec3 actual, glm::vec3 expected) {
    expect_near(actual, expected, 0x1p-11f * 1.5f);
}

/// As `seen`, with lightmaps of this light; `change` adjusts the light of the scene.
glm::vec3 seen_with_maps(const Scene& scene, MixedLighting mode, float light,
                         const std::function<void(SceneLight&)>& change = {}) {
    const ProbeVolume volume = make_volume(1.0f, mode);
    const Lightmaps maps = make_maps(scene, mode, light);
    auto scene_light = make_scene_light(scene, volume.view(), ProbeLight::AsTheScene, maps.view());
    EXPECT_TRUE(scene_light);
    if (change) change(*scene_light);
    const auto shader = SceneShader::make(scene, volume.view(), std::move(*scene_light));
    EXPECT_TRUE(shader);
    const auto shaded = shader->shade({1, 3, 0.5}, {0, -1, 0});
    EXPECT_TRUE(shaded);
    return shaded ? shaded->radiance : glm::vec3(-1.0f);
}

TEST(MixedShading, AShadowMaskReplacesTheShadowsOfStaticObjects) {
    constexpr float kVisible = 128.0f / 255.0f;
    Scene scene = roofed_floor(false);  // a ray would find the roof
    expect_light(seen_with_maps(scene, MixedLighting::Shadowmask, 0.5f),
                 (0.5f + kVisible) * kAlbedo);
    scene.instances[1].contributes_gi = false;  // it moves: a real-time shadow
    expect_light(seen_with_maps(scene, MixedLighting::Shadowmask, 0.5f), 0.5f * kAlbedo);
}

TEST(MixedShading, WithoutAMaskTheShadowsOfLightmapsAreInRealTime) {
    expect_light(seen_with_maps(roofed_floor(false), MixedLighting::Indirect, 0.5f),
                 0.5f * kAlbedo);
    Scene open;
    test::add_floor(open, test::diffuse(kAlbedo), 2.0f);
    expect_light(seen_with_maps(open, MixedLighting::Indirect, 0.5f), 1.5f * kAlbedo);
}

TEST(MixedShading, SubtractiveLightmapsHoldTheSunAndMovingObjectsSubtractIt) {
    Scene scene = roofed_floor(false);
    const auto with_color = [](float color) {
        return [color](SceneLight& light) { light.shadow_color = glm::vec3(color); };
    };
    const MixedLighting mode = MixedLighting::Subtractive;
    expect_light(seen_with_maps(scene, mode, 1.5f, with_color(0.2f)), 1.5f * kAlbedo);
    scene.instances[1].contributes_gi = false;
    expect_light(seen_with_maps(scene, mode, 1.5f, with_color(0.2f)), 0.5f * kAlbedo);
    expect_light(seen_with_maps(scene, mode, 1.5f, with_color(0.8f)), 0.8f * kAlbedo);
    expect_light(seen_with_maps(scene, mode, 0.3f, with_color(0.8f)), 0.3f * kAlbedo);
}

TEST(MixedShading, AmbientOcclusionDarkensLightmapsOnlyIfAsked) {
    const Scene scene = roofed_floor(false);
    const MixedLighting mode = MixedLighting::Indirect;
    expect_light(seen_with_maps(scene, mode, 0.5f), 0.5f * kAlbedo);
    expect_light(seen_with_maps(scene, mode, 0.5f,
                                [](SceneLight& light) { light.has_ambient_occlusion = true; }),
                 0.1f * kAlbedo);
}

TEST(MixedShading, LightmapsAndProbesNeedTheSameMixedLighting) {
    const Scene scene = roofed_floor(false);
    const Lightmaps maps = make_maps(scene, MixedLighting::Subtractive, 1.0f);
    ProbeVolume volume = make_volume(1.0f, MixedLighting::Shadowmask);
    const auto light_of = [&] {
        return make_scene_light(scene, volume.view(), ProbeLight::AsTheScene, maps.view());
    };
    const auto light = light_of();
    ASSERT_FALSE(light);
    EXPECT_EQ(light.error().code, ErrorCode::InvalidArgument);
    const std::string message = error_text(light.error());
    EXPECT_NE(message.find("subtractive and the probes with shadowmask"), std::string::npos)
        << message;
    volume.lights[0].mode = LightMode::Realtime;  // of which neither has anything
    EXPECT_TRUE(light_of());
}

}  // namespace
}  // namespace tetralight
