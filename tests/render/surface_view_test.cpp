// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/surface_view.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/base/half.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/render/health_balls.h>
#include <tetralight/render/render_scene.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"
#include "tests/support/volume_sun.h"

namespace tetralight {
namespace {

const glm::vec3 kAlbedo(0.8f, 0.4f, 0.2f);
const glm::vec3 kEmission(0.5f, 0.25f, 0.125f);
constexpr float kPi = std::numbers::pi_v<float>;

/// A floor of 2 m whose lightmap holds irradiance π, a sun from above of irradiance 2, and a
/// moving floor beside it.
struct LitFloor {
    Scene scene;
    Lightmaps maps;
    ProbeVolume volume;

    LitFloor() {
        test::add_floor(scene, test::diffuse(kAlbedo, kEmission), 1.0f);
        MeshInstance moving = scene.instances[0];
        moving.contributes_gi = false;
        moving.world_from_mesh[3] = {9, 0, 0, 1};
        scene.instances.push_back(moving);
        BakeLightmapsSettings settings;
        settings.bake.sample_count = 1;
        settings.layout.page_size = 64;
        maps = bake_lightmaps(scene, settings)->lightmaps;
        for (IrradianceTexel& texel : maps.irradiance) texel.rgb.fill(half_from_float(kPi));
        volume = test::make_lit_volume(test::random_positions(20, 1, 9.0));
        test::add_sun(volume, {0, -1, 0});
        volume.lights[0].intensity = glm::vec3(2.0f);
    }

    /// What is seen at (x, 0, z) from above.
    [[nodiscard]] glm::vec3 show(SurfaceView view, double x = 0.3, double z = 0.2) const {
        auto light = make_scene_light(scene, volume.view(), ProbeLight::AsTheScene, maps.view());
        const auto shader = SceneShader::make(scene, volume.view(), std::move(*light));
        const auto seen = shader->shade({x, 5, z}, {0, -1, 0}, view);
        EXPECT_TRUE(seen);
        return seen ? seen->radiance : glm::vec3(-1.0f);
    }
};

void expect_near(glm::vec3 actual, glm::vec3 expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 2e-3f);
}

TEST(SurfaceView, PartsOfTheLightAddUp) {
    const LitFloor floor;
    const glm::vec3 bounce = kAlbedo;  // E / π = 1
    const glm::vec3 direct = kAlbedo * (2.0f / kPi);
    expect_near(floor.show(SurfaceView::Bounce), bounce);
    expect_near(floor.show(SurfaceView::Direct), direct);
    expect_near(floor.show(SurfaceView::Emission), kEmission);
    expect_near(floor.show(SurfaceView::Received), glm::vec3(1.0f + 2.0f / kPi));
    expect_near(floor.show(SurfaceView::Shaded), bounce + direct + kEmission);
}

TEST(SurfaceView, BacksOfLightmapsTakeTheirLightFromProbes) {
    LitFloor floor;
    floor.scene.materials[0].is_double_sided = true;
    for (IrradianceSh& sh : floor.volume.irradiance)
        sh = irradiance_from_radiance(constant_radiance(glm::vec3(3.0f)));
    auto light = make_scene_light(floor.scene, floor.volume.view(), ProbeLight::AsTheScene,
                                  floor.maps.view());
    const auto shader = SceneShader::make(floor.scene, floor.volume.view(), std::move(*light));
    const auto below = shader->shade({0.3, -5, 0.2}, {0, 1, 0}, SurfaceView::Bounce);
    ASSERT_TRUE(below);
    expect_near(below->radiance, 3.0f * kAlbedo);
    expect_near(floor.show(SurfaceView::Bounce), kAlbedo);
}

TEST(SurfaceView, AlbedoIsEncoded) {
    const LitFloor floor;
    const glm::vec3 shown = floor.show(SurfaceView::Albedo);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(linear_from_srgb(shown[i]), kAlbedo[i], 1e-3f);
}

TEST(SurfaceView, UvsAreThoseBeforeAndAfterScaleAndOffset) {
    LitFloor floor;
    const LightmapRectangle& place = floor.maps.rectangles[0];
    const auto at = [&](SurfaceView view, double x) { return glm::vec2(floor.show(view, x, 0.0)); };
    // 1.6 m are 16 texels.
    EXPECT_NEAR(glm::distance(at(SurfaceView::LightmapUv, -0.8), at(SurfaceView::LightmapUv, 0.8)),
                16.0f / 64.0f, 1e-4f);
    EXPECT_NEAR(
        glm::distance(at(SurfaceView::UnwrappedUv, -0.8), at(SurfaceView::UnwrappedUv, 0.8)),
        16.0f / static_cast<float>(place.width), 1e-3f);
    const glm::vec2 before = at(SurfaceView::UnwrappedUv, 0.3);
    const glm::vec2 after = at(SurfaceView::LightmapUv, 0.3);
    EXPECT_NEAR(glm::distance(before * place.scale + place.offset, after), 0.0f, 1e-5f);
}

TEST(SurfaceView, TexelsAlternateEveryTenthOfAMetre) {
    const LitFloor floor;
    const auto texel = [&](double x) { return floor.show(SurfaceView::Texels, x, 0.0); };
    int change_count = 0;
    for (int i = 0; i < 100; ++i) {
        const double x = -0.793 + 0.016 * i;
        change_count += texel(x) != texel(x + 0.016);
    }
    EXPECT_EQ(change_count, 16);
}

TEST(SurfaceView, ValidityIsThatOfTheTexel) {
    LitFloor floor;
    for (uint8_t& validity : floor.maps.validity) validity = 51;
    expect_near(floor.show(SurfaceView::Validity), validity_color(0.2f));
    floor.maps.validity.clear();
    expect_near(floor.show(SurfaceView::Validity), glm::vec3(0.6f));
}

TEST(SurfaceView, PagesHaveDifferentHues) {
    LitFloor floor;
    const glm::vec3 first = floor.show(SurfaceView::Pages);
    floor.maps.rectangles[0].page = 1;
    EXPECT_GT(glm::distance(floor.show(SurfaceView::Pages), first), 0.1f);
}

TEST(SurfaceView, ObjectsWithoutLightmapAreGrey) {
    const LitFloor floor;
    for (const SurfaceView view :
         {SurfaceView::LightmapUv, SurfaceView::Texels, SurfaceView::Validity, SurfaceView::Pages})
        expect_near(floor.show(view, 9.0), glm::vec3(0.2f));
}

}  // namespace
}  // namespace tetralight
