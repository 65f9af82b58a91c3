// SPDX-License-Identifier: Apache-2.0
// Surfaces with normal maps, shaded by rays.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>

#include <tetralight/base/half.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/render/render_scene.h>
#include "tests/support/mapped_wall.h"
#include "tests/support/random_probes.h"
#include "tests/support/volume_sun.h"

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr glm::vec2 kTilt(0.6f, 0.3f);

/// A wall of 4 m in the plane z = 0 that faces +Z; u runs along +X, v along −Y.
Mesh make_wall() {
    Mesh wall;
    test::append_quad(wall, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
    for (glm::vec2& uv : wall.uvs[0]) uv.y = 1.0f - uv.y;
    return wall;
}

/// A wall with a normal map that is everywhere `kTilt`, seen from the front.
struct MappedWall {
    Scene scene;
    ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 1, 9.0));

    MappedWall() {
        Material material = test::diffuse(glm::vec3(0.5f));
        test::set_normal_map(scene, material, kTilt);
        test::add_mesh(scene, material, make_wall());
    }

    Material& material() { return scene.materials[0]; }

    [[nodiscard]] glm::vec3 see(const glm::dvec3& from = {0.3, 0.2, 5},
                                SurfaceView view = SurfaceView::Shaded,
                                const LightmapsView& maps = {},
                                LightmapLight lightmap_light = LightmapLight::Directional) const {
        auto light = make_scene_light(scene, volume.view(), ProbeLight::AsTheScene, maps);
        light->lightmap_light = lightmap_light;
        const auto shader = SceneShader::make(scene, volume.view(), std::move(*light));
        const glm::vec3 ahead(0.0f, 0.0f, from.z > 0.0 ? -1.0f : 1.0f);
        const auto seen = shader->shade(from, ahead, view);
        EXPECT_TRUE(seen);
        return seen ? seen->radiance : glm::vec3(-1.0f);
    }

    /// The same wall without the map, whose vertices have its normal.
    [[nodiscard]] MappedWall without_map() const {
        MappedWall other = *this;
        other.material().normal_texture = {};
        const glm::vec3 normal = test::stored_normal(kTilt);
        other.scene.meshes[0].normals.assign(4, normal);
        return other;
    }
};

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5f) {
    EXPECT_LT(glm::distance(actual, expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z << " instead of " << expected.x << ' '
        << expected.y << ' ' << expected.z;
}

TEST(NormalMap, UnderASunIsAWallOfThatNormal) {
    MappedWall wall;
    test::add_sun(wall.volume, {-0.5f, -0.5f, -1.0f});
    const MappedWall tilted = wall.without_map();
    MappedWall flat = wall;
    flat.material().normal_texture = {};
    EXPECT_GT(glm::distance(wall.see(), flat.see()), 0.05f);
    expect_near(wall.see(), tilted.see());
}

TEST(NormalMap, TakesTheLightOfProbesOnItsNormal) {
    MappedWall wall;
    for (IrradianceSh& light : wall.volume.irradiance) {
        RadianceSh radiance = constant_radiance(glm::vec3(1.0f));
        radiance.coefficients[3] += glm::vec3(0.5f);  // more from +X
        light = irradiance_from_radiance(radiance);
    }
    MappedWall flat = wall;
    flat.material().normal_texture = {};
    EXPECT_GT(glm::distance(wall.see(), flat.see()), 0.02f);
    expect_near(wall.see(), wall.without_map().see());
}

TEST(NormalMap, OfAMirroredInstanceIsMirrored) {
    MappedWall wall;
    test::add_sun(wall.volume, {-0.5f, -0.5f, -1.0f});
    MappedWall tilted = wall.without_map();
    for (MappedWall* each : {&wall, &tilted})
        each->scene.instances[0].world_from_mesh =
            glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
    expect_near(wall.see(), tilted.see());
}

TEST(NormalMap, SeenFromBehindIsTurnedAround) {
    MappedWall wall;
    wall.material().is_double_sided = true;
    test::add_sun(wall.volume, {0.5f, 0.2f, 1.0f});
    expect_near(wall.see({0.3, 0.2, -5}), wall.without_map().see({0.3, 0.2, -5}));
    EXPECT_GT(wall.see({0.3, 0.2, -5}).x, 0.05f);
}

TEST(NormalMap, ShowsItsNormals) {
    const glm::vec3 normal = test::stored_normal(kTilt);
    expect_near(MappedWall().see({0.3, 0.2, 5}, SurfaceView::Normal), 0.5f + 0.5f * normal);
}

/// Lightmaps of the wall with light from one direction: φ = 2 and v = 2 d.
Lightmaps make_maps(const Scene& scene, const glm::vec3& direction) {
    BakeLightmapsSettings settings;
    settings.bake.sample_count = 1;
    settings.layout.page_size = 128;
    Lightmaps maps = bake_lightmaps(scene, settings)->lightmaps;
    for (LightmapTexel& texel : maps.light) {
        texel.flux.fill(half_from_float(2.0f / maps.info.scale));
        for (auto& vector : texel.vector) {
            for (int axis = 0; axis < 3; ++axis)
                vector[static_cast<size_t>(axis)] =
                    half_from_float(2.0f * direction[axis] / maps.info.scale);
        }
    }
    for (IrradianceTexel& texel : maps.irradiance)
        texel.rgb.fill(half_from_float(2.0f * direction.z / maps.info.scale));
    return maps;
}

TEST(NormalMap, TakesTheLightOfLightmapsOnItsNormal) {
    const MappedWall wall;
    const glm::vec3 direction(0.6f, 0.0f, 0.8f);
    const Lightmaps maps = make_maps(wall.scene, direction);
    const auto received = [&](LightmapLight light) {
        return wall.see({0.3, 0.2, 5}, SurfaceView::Received, maps.view(), light).x * kPi;
    };
    const glm::vec3 normal = test::stored_normal(kTilt);
    EXPECT_NEAR(received(LightmapLight::Directional), 2.0f * glm::dot(normal, direction), 3e-3f);
    EXPECT_NEAR(received(LightmapLight::Flat), 2.0f * direction.z, 2e-3f);
}

TEST(NormalMap, WithoutDirectionsInLightmapsIsFlat) {
    const MappedWall wall;
    Lightmaps maps = make_maps(wall.scene, {0.6f, 0.0f, 0.8f});
    maps.light.clear();
    EXPECT_NEAR(wall.see({0.3, 0.2, 5}, SurfaceView::Received, maps.view()).x * kPi, 1.6f, 2e-3f);
}

}  // namespace
}  // namespace tetralight
