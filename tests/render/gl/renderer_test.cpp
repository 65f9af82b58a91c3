// SPDX-License-Identifier: Apache-2.0
// Pictures by OpenGL against those by rays, from the same light. Any complaint of OpenGL is an
// error of the renderer, and fails here.
#include <tetralight/render/gl/renderer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_visibility.h>
#include <tetralight/render/gl/gl_pictures.h>
#include <tetralight/render/render_gizmos.h>
#include <tetralight/render/render_scene.h>
#include "tests/support/mapped_wall.h"
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"
#include "tests/support/volume_sun.h"

namespace tetralight {
namespace {

const glm::vec3 kAlbedo(0.8f, 0.4f, 0.2f);
const Camera kCamera = look_at({3, 5, 9}, {0, 1, 0}, 0.8);

/// Sees 8 metres from the lower to the upper edge, by parallel rays.
Camera orthographic(Camera camera = kCamera) {
    camera.half_height = 4.0;
    return camera;
}

RenderSettings small_settings() {
    RenderSettings settings;
    settings.width = 64;
    settings.height = 48;
    settings.samples_per_axis = 1;
    return settings;
}

/// Probes all over [-9, 9]³, whose light is positive and differs from place to place.
ProbeVolume varied_volume() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 1, 9.0));
    for (size_t i = 0; i < volume.irradiance.size(); ++i) {
        const auto p = glm::vec3(volume.exact_positions[i]);
        RadianceSh light = constant_radiance(glm::vec3(1.0f) + 0.05f * p);
        light.coefficients[2] += glm::vec3(0.3f + 0.02f * p.y);
        light.coefficients[5] += glm::vec3(0.02f * p.x);
        volume.irradiance[i] = irradiance_from_radiance(light);
    }
    volume.info.ambient = irradiance_from_radiance(constant_radiance({0.2f, 0.3f, 0.5f}));
    return volume;
}

/// A floor and a thin wall that stands on it at x = 0.5, so that the camera sees both sides.
Scene wall_on_floor() {
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo), 6.0f);
    test::add_quad(scene, test::diffuse(kAlbedo), {0.5f, 0, -6}, {0, 1.5f, 0}, {0, 0, 12});
    return scene;
}

/// A floor, and a box on it.
Scene box_on_floor() {
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo), 6.0f);
    test::add_box(scene, test::diffuse({0.3f, 0.6f, 0.9f}), test::Facing::Outward, {-1, 0, -1},
                  {1, 2, 1});
    return scene;
}

/// Lightmaps of several pages whose light differs from texel to texel.
Lightmaps varied_lightmaps(const Scene& scene) {
    BakeLightmapsSettings settings;
    settings.bake.sample_count = 1;
    settings.layout.texels_per_meter = 2.0;
    settings.layout.page_size = 32;
    Lightmaps maps = bake_lightmaps(scene, settings)->lightmaps;
    maps.info.scale = 2.0f;
    for (size_t i = 0; i < maps.irradiance.size(); ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            const auto step = static_cast<float>((i * (channel + 3)) % 7);
            maps.irradiance[i].rgb[channel] = half_from_float(1.0f + 0.3f * step);
        }
    }
    return maps;
}

class GlRenderer : public testing::Test {
  protected:
    void SetUp() override {
        auto created = OffscreenContext::create();
        if (!created) GTEST_SKIP() << error_text(created.error());
        context_.emplace(std::move(*created));
    }

    static ImageF draw(const Scene& scene, const ProbeVolume& volume, const Camera& camera,
                       const RenderSettings& settings = small_settings(),
                       const LightmapsView& lightmaps = {}) {
        const auto light =
            make_scene_light(scene, volume.view(), ProbeLight::AsTheScene, lightmaps);
        auto renderer = Renderer::make(scene, volume.view(), *light, {.shadow_map_size = 1024});
        if (!renderer) {
            ADD_FAILURE() << error_text(renderer.error());
            return {};
        }
        const auto image = renderer->render(camera, settings, {});
        EXPECT_TRUE(image) << error_text(image.error());
        return image ? *image : ImageF{};
    }

    /// Share of pixels that differ by more than 2 % of the brightest radiance.
    static double difference(const Scene& scene, const ProbeVolume& volume,
                             const Camera& camera = kCamera, const LightmapsView& lightmaps = {}) {
        const ImageF gl = draw(scene, volume, camera, small_settings(), lightmaps);
        const ImageF rays =
            *render_scene(scene, volume.view(), camera, small_settings(), lightmaps);
        EXPECT_EQ(gl.pixels.size(), rays.pixels.size());
        if (gl.pixels.size() != rays.pixels.size()) return 1.0;
        float brightest = 0.0f;
        for (const glm::vec3& p : rays.pixels) brightest = std::max({brightest, p.x, p.y, p.z});
        size_t count = 0;
        for (size_t i = 0; i < rays.pixels.size(); ++i) {
            const glm::vec3 apart = glm::abs(gl.pixels[i] - rays.pixels[i]);
            count += !(std::max({apart.x, apart.y, apart.z}) <= 0.02f * brightest);
        }
        return static_cast<double>(count) / static_cast<double>(rays.pixels.size());
    }

    std::optional<OffscreenContext> context_;
};

/// Edges may fall on another pixel.
constexpr double kEdges = 0.01;
/// Texels of shadow maps are not rays.
constexpr double kShadowEdges = 0.03;

TEST_F(GlRenderer, SurfaceUnderConstantLightShowsAlbedoTimesRadiance) {
    Scene scene;
    test::add_floor(scene, test::diffuse(kAlbedo), 50.0f);
    ProbeVolume volume;
    volume.info.ambient = irradiance_from_radiance(constant_radiance({1, 2, 3}));
    const ImageF image = draw(scene, volume, look_at({0, 5, 0.1}, {0, 0, 0}, 0.8));
    for (const glm::vec3& pixel : image.pixels) {
        EXPECT_NEAR(glm::distance(pixel, kAlbedo * glm::vec3(1, 2, 3)), 0.0f, 1e-3f);
    }
}

TEST_F(GlRenderer, AgreesWithRaysOnProbesAndSky) {
    EXPECT_LE(difference(box_on_floor(), varied_volume()), kEdges);
}

TEST_F(GlRenderer, AgreesOnWallsThatHideProbes) {
    const Scene scene = wall_on_floor();
    ProbeVolume volume = varied_volume();
    for (size_t i = 0; i < volume.irradiance.size(); ++i) {
        const float light = volume.exact_positions[i].x > 0.5 ? 4.0f : 0.25f;
        volume.irradiance[i] = irradiance_from_radiance(constant_radiance(glm::vec3(light)));
    }
    const ImageF plain = draw(scene, volume, kCamera);
    bake_visibility(*TraceScene::make_static(scene), volume.exact_positions, 0, volume);
    EXPECT_LE(difference(scene, volume), kEdges);
    const ImageF walls = draw(scene, volume, kCamera);
    ASSERT_EQ(walls.pixels.size(), plain.pixels.size());
    size_t changed_count = 0;
    for (size_t i = 0; i < walls.pixels.size(); ++i) {
        changed_count += glm::distance(walls.pixels[i], plain.pixels[i]) > 0.1f;
    }
    EXPECT_GT(changed_count, walls.pixels.size() / 20);
}

TEST_F(GlRenderer, AgreesFarFromTheWorldsOrigin) {
    const glm::dvec3 far(4e5, -2e5, 3e5);
    Scene scene = box_on_floor();
    for (MeshInstance& instance : scene.instances) {
        instance.world_from_mesh = glm::translate(glm::dmat4(1.0), far);
    }
    ProbeVolume volume = varied_volume();
    volume.info.world_origin += far;
    EXPECT_LE(difference(scene, volume, look_at(far + glm::dvec3(3, 5, 9), far, 0.8)), kEdges);
}

TEST_F(GlRenderer, AgreesOnMovingThingsThatAreScaledAndMirrored) {
    Scene scene = box_on_floor();
    scene.instances[1].contributes_gi = false;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 2, 0.5));
    scene.instances[1].world_from_mesh = glm::scale(turned, glm::dvec3(-1.5, 0.4, 1.0));
    EXPECT_LE(difference(scene, varied_volume()), kEdges);
}

TEST_F(GlRenderer, AgreesOnProxyVolumes) {
    Scene scene = box_on_floor();
    scene.instances[1].contributes_gi = false;
    scene.instances[1].node = 0;
    scene.nodes.push_back({"box", kNoIndex, glm::dmat4(1.0), LightProbeUsage::ProxyVolume});
    EXPECT_LE(difference(scene, varied_volume()), kEdges);
}

TEST_F(GlRenderer, AgreesOnLightmapsBesideProbes) {
    Scene scene = box_on_floor();
    MeshInstance mirrored = scene.instances[1];
    mirrored.world_from_mesh =
        glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-2.5, 0, 0)), glm::dvec3(-0.5));
    scene.instances.push_back(mirrored);
    // A sheet that shows the camera its back.
    Material sheet = test::diffuse(kAlbedo);
    sheet.is_double_sided = true;
    test::add_quad(scene, sheet, {-4, 0, -2}, {0, 2, 0}, {2, 0, 0});
    MeshInstance moving = scene.instances[1];
    moving.contributes_gi = false;
    moving.world_from_mesh = glm::translate(glm::dmat4(1.0), glm::dvec3(2.5, 0, 1));
    scene.instances.insert(scene.instances.begin(), moving);
    const Lightmaps maps = varied_lightmaps(scene);
    EXPECT_GT(maps.info.page_count, 1u);
    EXPECT_EQ(maps.rectangles[0].page, kNoIndex);
    EXPECT_LE(difference(scene, varied_volume(), kCamera, maps.view()), kEdges);
}

TEST_F(GlRenderer, AgreesOnShadowsOfLightmaps) {
    for (const auto mode :
         {MixedLighting::Indirect, MixedLighting::Shadowmask, MixedLighting::Subtractive}) {
        ProbeVolume volume = varied_volume();
        test::add_sun(volume, {0.5f, -1.0f, 0.3f});
        volume.light_states[0] = {mode, 0, kNoIndex, 0};
        if (mode == MixedLighting::Indirect) volume.light_states[0].channel = kNoIndex;
        volume.occlusion.assign(60, {0.25f, 1, 1, 1});
        volume.occlusion_lights.assign(60, {0, kNoIndex, kNoIndex, kNoIndex});
        Scene scene = box_on_floor();
        MeshInstance moving = scene.instances[1];
        moving.contributes_gi = false;
        moving.world_from_mesh = glm::translate(glm::dmat4(1.0), glm::dvec3(2.5, 0.3, 1));
        scene.instances.push_back(moving);
        Lightmaps maps = varied_lightmaps(scene);
        maps.info.mixed_lighting = mode;
        if (mode == MixedLighting::Shadowmask) {
            for (size_t i = 0; i < maps.irradiance.size(); ++i)
                maps.shadow_mask.push_back({static_cast<uint8_t>(i % 5 * 60), 255, 0, 255});
        }
        EXPECT_LE(difference(scene, volume, kCamera, maps.view()), kShadowEdges) << name_of(mode);
    }
}

/// A floor with a relief of 8 × 8 texels, a box whose tangents are those of its vertices, and a
/// mirrored one beside it, whose map is turned by a texture transform.
Scene mapped_scene() {
    Scene scene = box_on_floor();
    for (Material& material : scene.materials) test::set_normal_map(scene, material, {0.3f, -0.5f});
    Image8& relief = scene.normal_maps[0].image;
    relief = {8, 8, {}};
    for (int i = 0; i < 64; ++i) {
        const auto wave = [](int step) {
            return 0.4f * std::sin(0.785f * static_cast<float>(step));
        };
        relief.pixels.push_back(test::normal_texel(wave(i % 8), wave(i / 8 + 2)));
    }
    Mesh& box = scene.meshes[1];
    for (const glm::vec3& normal : box.normals)
        box.tangents.emplace_back(glm::vec3(normal.y, normal.z, normal.x), -1.0f);
    scene.meshes.push_back(box);
    scene.materials.push_back(scene.materials[1]);
    scene.materials[2].normal_texture.image_from_mesh =
        glm::mat3(glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1));
    scene.meshes[2].material = 2;
    MeshInstance mirrored = scene.instances[1];
    mirrored.mesh = 2;
    mirrored.world_from_mesh = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-3, 0, 0)),
                                          glm::dvec3(-0.5, 0.5, 0.5));
    scene.instances.push_back(mirrored);
    Material sheet = scene.materials[1];  // it shows the camera its back
    sheet.is_double_sided = true;
    test::add_quad(scene, sheet, {2, 0, -2}, {0, 2, 0}, {2, 0, 0});
    return scene;
}

TEST_F(GlRenderer, AgreesOnNormalMapsInTheLightOfProbesAndASun) {
    Scene scene = mapped_scene();
    ProbeVolume volume = varied_volume();
    test::add_sun(volume, {-0.5f, -1.0f, -0.8f});
    EXPECT_LE(difference(scene, volume), kShadowEdges);
    const ImageF mapped = draw(scene, volume, kCamera);
    for (Material& material : scene.materials) material.normal_texture = {};
    const ImageF flat = draw(scene, volume, kCamera);
    size_t count = 0;
    for (size_t i = 0; i < flat.pixels.size(); ++i)
        count += glm::distance(flat.pixels[i], mapped.pixels[i]) > 0.02f;
    EXPECT_GT(count, flat.pixels.size() / 4);
}

TEST_F(GlRenderer, AgreesOnNormalMapsInTheLightOfLightmaps) {
    const Scene scene = mapped_scene();
    Lightmaps maps = varied_lightmaps(scene);
    for (size_t i = 0; i < maps.light.size(); ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            const auto step = static_cast<float>((i * (channel + 3)) % 7);
            maps.light[i].flux[channel] = half_from_float(1.0f + 0.2f * step);
            maps.light[i].vector[channel] = {half_from_float(0.3f), half_from_float(0.6f),
                                             half_from_float(0.1f * step)};
        }
    }
    EXPECT_LE(difference(scene, varied_volume(), kCamera, maps.view()), kEdges);
}

TEST_F(GlRenderer, AgreesOnTheSunAndItsShadows) {
    ProbeVolume volume = varied_volume();
    test::add_sun(volume, {0.5f, -1.0f, 0.3f});
    EXPECT_LE(difference(box_on_floor(), volume), kShadowEdges);
}

TEST_F(GlRenderer, AgreesOnLampsAndTheirShadows) {
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Disc}) {
        ProbeVolume volume = varied_volume();
        test::add_sun(volume, {0.2f, -1.0f, 0.1f});
        Light& light = volume.lights[0];
        light.type = type;
        light.position = {2.5f, 4.0f, 1.0f};
        light.intensity = glm::vec3(30.0f);
        light.range = 12.0f;
        light.radius = type == LightType::Disc ? 0.5f : 0.0f;
        EXPECT_LE(difference(box_on_floor(), volume), kShadowEdges) << static_cast<int>(type);
    }
}

TEST_F(GlRenderer, OnMovingThingsProbesHoldTheShadowsOfStillOnes) {
    for (const bool floor_moves : {false, true}) {
        ProbeVolume volume = varied_volume();
        test::add_sun(volume, {0.1f, -1.0f, 0.2f});
        volume.light_states[0] = {MixedLighting::Shadowmask, 0, kNoIndex, 0};
        volume.occlusion.assign(60, {0.25f, 1, 1, 1});
        volume.occlusion_lights.assign(60, {0, kNoIndex, kNoIndex, kNoIndex});
        Scene scene = box_on_floor();
        scene.instances[0].contributes_gi = !floor_moves;
        scene.instances[1].contributes_gi = false;
        test::add_ceiling(scene, test::diffuse(kAlbedo), 9.0f, 8.0f);
        EXPECT_LE(difference(scene, volume), kShadowEdges) << floor_moves;
    }
}

TEST_F(GlRenderer, AgreesOnTexturesAndHoles) {
    Scene scene = box_on_floor();
    Texture texture;
    texture.image = {2, 2, {{255, 0, 0, 255}, {0, 255, 0, 0}, {0, 0, 255, 255}, {90, 90, 90, 0}}};
    scene.textures.push_back(texture);
    Material& floor = scene.materials[0];
    floor.base_color_texture.texture = 0;
    floor.alpha_mode = AlphaMode::Mask;
    EXPECT_LE(difference(scene, varied_volume()), 2 * kEdges);
}

TEST_F(GlRenderer, BlendedSurfacesLetTheirShareThrough) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), 50.0f);
    Material& pane =
        scene.materials[test::add_floor(scene, test::diffuse(glm::vec3(0.0f)), 50.0f, 1.0f).mesh];
    pane.alpha_mode = AlphaMode::Blend;
    pane.base_color.a = 0.25f;
    const ImageF image = draw(scene, varied_volume(), look_at({0, 5, 0.1}, {0, 0, 0}, 0.8));
    for (const glm::vec3& pixel : image.pixels) EXPECT_NEAR(pixel.y, 0.75f, 1e-3f);
}

TEST_F(GlRenderer, ASceneWithoutAnythingIsTheSky) {
    const ProbeVolume volume = varied_volume();
    for (const glm::vec3& pixel : draw({}, volume, kCamera).pixels) {
        EXPECT_NEAR(glm::distance(pixel, glm::vec3(0.2f, 0.3f, 0.5f)), 0.0f, 1e-3f);
    }
}

TEST_F(GlRenderer, MoreSamplesSmoothEdges) {
    RenderSettings settings = small_settings();
    settings.samples_per_axis = 4;
    const ImageF gl = draw(box_on_floor(), varied_volume(), kCamera, settings);
    const ImageF rays = *render_scene(box_on_floor(), varied_volume().view(), kCamera, settings);
    ASSERT_EQ(gl.pixels.size(), rays.pixels.size());
    double sum = 0.0;
    for (size_t i = 0; i < gl.pixels.size(); ++i) {
        sum += static_cast<double>(glm::distance(gl.pixels[i], rays.pixels[i]));
    }
    EXPECT_LE(sum / static_cast<double>(gl.pixels.size()), 0.01);
}

TEST_F(GlRenderer, DepthAgreesWithRays) {
    const Scene scene = box_on_floor();
    const ProbeVolume volume = varied_volume();
    const auto light = make_scene_light(scene, volume.view(), ProbeLight::AsTheScene);
    auto renderer = Renderer::make(scene, volume.view(), *light);
    ASSERT_TRUE(renderer);
    const auto shader = SceneShader::make(scene, volume.view());
    for (const Camera& camera : {kCamera, orthographic()}) {
        const auto depth = renderer->depth(camera, small_settings(), {});
        ASSERT_TRUE(depth) << error_text(depth.error());
        const auto rays =
            ray_traced_pictures(*shader, volume.view()).depth(camera, small_settings(), {});
        size_t count = 0;
        for (size_t i = 0; i < rays->depths.size(); ++i) {
            for (size_t j = 0; j < 4; ++j) {
                const float a = depth->depths[i][j], b = rays->depths[i][j];
                count += a != b && !(std::abs(a - b) <= 1e-3f * b);
            }
        }
        EXPECT_LE(count, rays->depths.size() / 50);
    }
}

TEST_F(GlRenderer, OrthographicPicturesAgreeWithRays) {
    ProbeVolume volume = varied_volume();
    EXPECT_LE(difference(wall_on_floor(), volume, orthographic()), kEdges);
    // Looking up, past the edge of the floor and through the sky.
    const Camera low = orthographic(look_at({0, -1, 9}, {0, 1, 0}, 0.8));
    EXPECT_LE(difference(box_on_floor(), volume, low), kEdges);
    test::add_sun(volume, {0.5f, -1.0f, 0.3f});
    EXPECT_LE(difference(box_on_floor(), volume, orthographic()), kShadowEdges);
}

TEST_F(GlRenderer, OrthographicPicturesDoNotDependOnTheDistance) {
    const ProbeVolume volume = varied_volume();
    const ImageF near = draw(box_on_floor(), volume, orthographic());
    Camera camera = orthographic();
    camera.world_from_camera[3] += 1e5 * camera.world_from_camera[2];
    const ImageF far = draw(box_on_floor(), volume, camera);
    ASSERT_EQ(near.pixels.size(), far.pixels.size());
    size_t count = 0;
    for (size_t i = 0; i < near.pixels.size(); ++i) {
        count += !(glm::distance(near.pixels[i], far.pixels[i]) <= 0.01f);
    }
    EXPECT_LE(count, near.pixels.size() / 100);
}

TEST_F(GlRenderer, OrthographicCamerasDoNotSeeWhatIsBehindThem) {
    const ProbeVolume volume = varied_volume();
    Camera camera = orthographic();
    camera.world_from_camera[3] -= 30.0 * camera.world_from_camera[2];
    for (const glm::vec3& pixel : draw(box_on_floor(), volume, camera).pixels) {
        EXPECT_NEAR(glm::distance(pixel, glm::vec3(0.2f, 0.3f, 0.5f)), 0.0f, 1e-3f);
    }
}

TEST_F(GlRenderer, OrthographicPicturesShowBallsBehindTheScene) {
    const Scene scene = box_on_floor();
    const ProbeVolume volume = varied_volume();
    const auto light = make_scene_light(scene, volume.view(), ProbeLight::AsTheScene);
    auto pictures = GlPictures::make(scene, volume.view(), *light);
    ASSERT_TRUE(pictures);
    const LightBall ball{
        {0, 5, -300}, 1.0f, irradiance_from_radiance(constant_radiance({1, 2, 3}))};
    const Camera camera = orthographic(look_at({0, 5, 9}, {0, 5, 0}, 0.8));
    const auto image = pictures->source().radiance(camera, small_settings(), std::span(&ball, 1));
    ASSERT_TRUE(image) << error_text(image.error());
    const glm::vec3 middle = image->pixels[24 * 64 + 32];
    EXPECT_NEAR(glm::distance(middle, glm::vec3(1, 2, 3)), 0.0f, 1e-3f);
}

TEST_F(GlRenderer, OrthographicPicturesBlendInTheOrderOfDepth) {
    // The centre of the front pane is farther from the eye than that of the one behind it.
    const auto pane = [](Scene& scene, glm::vec3 emission, glm::vec3 corner, float width) {
        Material material = test::diffuse(glm::vec3(0.0f), emission);
        material.alpha_mode = AlphaMode::Blend;
        material.base_color.a = 0.5f;
        test::add_quad(scene, material, corner, {width, 0, 0}, {0, 2, 0});
    };
    Scene scene;
    pane(scene, {1, 0, 0}, {-1, -1, 1}, 50.0f);
    pane(scene, {0, 1, 0}, {-1, -1, -1}, 2.0f);
    const ImageF image =
        draw(scene, varied_volume(), orthographic(look_at({0, 0, 10}, {0, 0, 0}, 0.8)));
    const glm::vec3 behind = 0.5f * glm::vec3(0, 1, 0) + 0.5f * glm::vec3(0.2f, 0.3f, 0.5f);
    const glm::vec3 expected = 0.5f * glm::vec3(1, 0, 0) + 0.5f * behind;
    EXPECT_NEAR(glm::distance(image.pixels[24 * 64 + 32], expected), 0.0f, 1e-3f);
}

TEST_F(GlRenderer, BallsShowTheirLight) {
    const ProbeVolume volume = varied_volume();
    const auto light = make_scene_light({}, volume.view(), ProbeLight::AsTheScene);
    auto pictures = GlPictures::make({}, volume.view(), *light);
    ASSERT_TRUE(pictures);
    const LightBall ball{{0, 0, 0}, 3.0f, irradiance_from_radiance(constant_radiance({1, 2, 3}))};
    const auto image = pictures->source().radiance(look_at({0, 0, 9}, {0, 0, 0}, 0.3),
                                                   small_settings(), std::span(&ball, 1));
    ASSERT_TRUE(image) << error_text(image.error());
    const glm::vec3 middle = image->pixels[24 * 64 + 32];
    EXPECT_NEAR(glm::distance(middle, glm::vec3(1, 2, 3)), 0.0f, 1e-3f);
}

TEST_F(GlRenderer, RefusesPicturesThatOpenGlDoesNotHold) {
    const ProbeVolume volume = varied_volume();
    const auto light = make_scene_light({}, volume.view(), ProbeLight::AsTheScene);
    auto renderer = Renderer::make({}, volume.view(), *light);
    RenderSettings settings = small_settings();
    settings.width = 1'000'000;
    const auto image = renderer->render(kCamera, settings, {});
    ASSERT_FALSE(image);
    EXPECT_EQ(error_text(image.error()).find("OpenGL: the picture is larger than"), 0u);
}

}  // namespace
}  // namespace tetralight
