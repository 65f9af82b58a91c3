// SPDX-License-Identifier: Apache-2.0
// Bakes of lightmaps at the limits of sizes, counts and numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/pipeline/baked_scene.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

using test::BakedScene;

constexpr double kPi = std::numbers::pi;

const Material kGrey = test::diffuse(glm::vec3(0.5f));

Scene under_white_sky() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    return scene;
}

double constant_pi(const glm::dvec3&) {
    return kPi;
}

/// A ground plane of 10 km with a box of 1 m that stands on it, far from its middle.
Scene large_ground() {
    Scene scene = under_white_sky();
    test::add_floor(scene, kGrey, 5000.0f).lightmap.scale = 0.001f;
    test::add_box(scene, kGrey, test::Facing::Outward, {4000, 0, -3001}, {4001, 1, -3000});
    test::add_sun(scene, LightMode::Baked, glm::vec3(2.0f)).direction =
        glm::normalize(glm::vec3(1, -1, 0));
    return scene;
}

TEST(LightmapLimits, AGroundOf10KilometresDoesNotShadeItself) {
    const BakedScene baked(large_ground(), test::lightmap_settings(64));
    const double sun = 2.0 * std::sqrt(0.5);
    const auto ground = baked.texels(0);
    EXPECT_GE(ground.size(), 100u * 100u);
    for (const test::SampledTexel& texel : ground) {
        EXPECT_EQ(texel.position.y, 0.0);
        EXPECT_NEAR(texel.irradiance, kPi + sun, 0.15);
    }
    // A texel of 100 m sees nothing of the box.
    EXPECT_NEAR(baked.irradiance_at(0, {4000.5, 0, -3000.5}), kPi + sun, 0.15);
}

TEST(LightmapLimits, ABoxOnALargeGroundHasTheLightOfABox) {
    const BakedScene baked(large_ground(), test::lightmap_settings(256));
    const double sun = 2.0 * std::sqrt(0.5);
    for (const double x : {4000.05, 4000.5, 4000.95}) {
        EXPECT_NEAR(baked.irradiance_at(1, {x, 1, -3000.5}), kPi + sun, 0.05);
        // Half of the sky, and a ground in the sun that reflects half of its light.
        const double ground = 0.5 * (kPi + sun) / kPi;
        EXPECT_NEAR(baked.irradiance_at(1, {x, 0.8, -3000}), 0.5 * kPi * (1.0 + ground), 0.15);
    }
    EXPECT_NEAR(baked.irradiance_at(1, {4000, 0.8, -3000.5}),
                0.5 * kPi * (1.0 + 0.5 * (kPi + sun) / kPi) + sun, 0.15);
}

/// n × n tiles of one mesh of one texel each, apart.
Scene many_tiles(int n) {
    Scene scene = under_white_sky();
    test::add_quad(scene, kGrey, {0, 0, 0}, {0, 0, 0.1f}, {0.1f, 0, 0});
    const MeshInstance tile = scene.instances[0];
    scene.instances.clear();
    for (int i = 0; i < n * n; ++i) {
        scene.instances.push_back(tile);
        scene.instances.back().world_from_mesh =
            glm::translate(glm::dmat4(1.0), glm::dvec3(0.2 * (i % n), 0, 0.2 * (i / n)));
    }
    return scene;
}

/// True if no texel belongs to two rectangles, and all lie in the pages.
bool are_apart(const Lightmaps& maps) {
    const size_t size = maps.info.page_size;
    std::vector<bool> is_used(maps.view().texel_count(), false);
    for (const LightmapRectangle& place : maps.rectangles) {
        if (place.page >= maps.info.page_count) return false;
        if (place.x + place.width > size || place.y + place.height > size) return false;
        for (size_t y = place.y; y < place.y + place.height; ++y) {
            for (size_t x = place.x; x < place.x + place.width; ++x) {
                const size_t texel = (place.page * size + y) * size + x;
                if (is_used[texel]) return false;
                is_used[texel] = true;
            }
        }
    }
    return true;
}

TEST(LightmapLimits, TenThousandInstancesShareTheirChartsAndHaveTheirOwnTexels) {
    const BakedScene baked(many_tiles(100), test::lightmap_settings(16));
    const Lightmaps& maps = baked.maps();
    ASSERT_EQ(maps.rectangles.size(), 10'000u);
    EXPECT_EQ(maps.meshes.size(), 1u);
    EXPECT_EQ(maps.corner_uvs.size(), 6u);
    EXPECT_TRUE(are_apart(maps));
    const uint64_t needed = 10'000u * maps.rectangles[0].width * maps.rectangles[0].height;
    EXPECT_LE(maps.view().texel_count(), needed + needed / 5 + 256 * 256);
    EXPECT_EQ(baked.report().seam_count, 0u);
    double sum = 0.0;
    for (uint32_t i = 0; i < 10'000; ++i) {
        const double value = baked.irradiance_at(i, 0, glm::dvec3(baked.corners(i, 0)[0]));
        EXPECT_NEAR(value, kPi, 0.4) << i;
        sum += value;
    }
    EXPECT_NEAR(sum / 10'000, kPi, 0.01);
}

/// A floor of 2 × 2 quads whose TEXCOORD_1 are moved and scaled.
Scene floor_with_uvs(float scale, float offset) {
    Scene scene = under_white_sky();
    Mesh mesh;
    for (int i = 0; i < 4; ++i) test::append_quad(mesh, {i % 2, 0, i / 2}, {0, 0, 1}, {1, 0, 0});
    for (const glm::vec3& position : mesh.positions)
        mesh.uvs[1].push_back(scale * glm::vec2(position.x, position.z) + offset);
    test::add_mesh(scene, kGrey, std::move(mesh)).name = "floor";
    return scene;
}

TEST(LightmapLimits, TilesFarFromTheOriginHaveTheSameLight) {
    Scene scene = many_tiles(3);
    for (MeshInstance& tile : scene.instances) {
        const glm::dvec3 offset(0.5 * glm::dvec3(tile.world_from_mesh[3]));
        tile.world_from_mesh[3] = glm::dvec4(offset + glm::dvec3(3e6, 500, -7e6), 1.0);
    }
    const BakedScene baked(scene, test::lightmap_settings(128));
    EXPECT_EQ(baked.report().seam_count, 12u);
    EXPECT_EQ(baked.report().invalid_count, 0u);
    for (uint32_t i = 0; i < 9; ++i) {
        for (const test::SampledTexel& texel : baked.texels(i))
            EXPECT_NEAR(texel.irradiance, kPi, 0.1);
    }
}

TEST(LightmapLimits, AUnitQuadThatIsScaledTo10KilometresIsAGroundToo) {
    Scene scene = under_white_sky();
    MeshInstance& ground = test::add_floor(scene, kGrey, 0.5f);
    ground.lightmap.scale = 0.0005f;
    ground.world_from_mesh = glm::scale(glm::dmat4(1.0), glm::dvec3(1e4, 1.0, 1e4));
    const BakedScene baked(scene, test::lightmap_settings(64));
    const auto texels = baked.texels(0);
    EXPECT_GE(texels.size(), 50u * 50u);
    EXPECT_LE(texels.size(), 52u * 52u);
    EXPECT_EQ(baked.report().invalid_count, 0u);
    test::expect_light(texels, constant_pi);
}

TEST(LightmapLimits, UvsAtAMillionThatCollapseAreKept) {
    // At 1e6 floats are 1/16 apart: half of the quads lose their width.
    Scene scene = under_white_sky();
    Mesh mesh;
    constexpr float kStep = 0x1p-4f;
    for (int i = 0; i < 32 * 32; ++i) {
        const glm::vec3 corner(i % 32, 0, i / 32);
        test::append_quad(mesh, kStep * corner, {0, 0, kStep}, {kStep, 0, 0});
    }
    for (const glm::vec3& position : mesh.positions)
        mesh.uvs[1].push_back(0.5f * glm::vec2(position.x, position.z) + 1e6f);
    test::add_mesh(scene, kGrey, std::move(mesh)).name = "floor";
    BakeLightmapsSettings settings = test::lightmap_settings(128);
    settings.layout.uvs = LightmapUvs::Keep;
    const BakedScene baked(scene, settings);
    EXPECT_EQ(baked.report().warnings.size(), 1u);
    for (const double x : {0.02, 0.34, 1.03, 1.97})
        EXPECT_NEAR(baked.irradiance_at(0, {x, 0, 1.27}), kPi, 0.1) << x;
}

TEST(LightmapLimits, UvsAtAMillionAreKept) {
    for (const auto& [scale, offset] : {std::pair(0.5f, 1e6f), std::pair(1e6f, 0.0f)}) {
        BakeLightmapsSettings settings = test::lightmap_settings(128);
        settings.layout.uvs = LightmapUvs::Keep;
        const BakedScene baked(floor_with_uvs(scale, offset), settings);
        ASSERT_EQ(baked.report().warnings.size(), 1u);
        EXPECT_TRUE(baked.report().warnings[0].starts_with("object \"floor\": TEXCOORD_1 leaves "))
            << baked.report().warnings[0];
        const auto texels = baked.texels(0);
        EXPECT_GE(texels.size(), 20u * 20u);
        EXPECT_LE(texels.size(), 23u * 23u);
        test::expect_light(texels, constant_pi);
        for (const double x : {0.001, 0.999, 1.7})
            EXPECT_NEAR(baked.irradiance_at(0, {x, 0, 1.3}), kPi, 0.1);
    }
}

TEST(LightmapLimits, UvsAtAMillionAreRepaired) {
    // Too far away for floats to tell the corners apart.
    for (const float offset : {1e6f, 1e12f}) {
        BakeLightmapsSettings settings = test::lightmap_settings(128);
        settings.layout.uvs = LightmapUvs::Repair;
        const BakedScene baked(floor_with_uvs(0.5f, offset), settings);
        ASSERT_EQ(baked.report().warnings.size(), 1u);
        EXPECT_TRUE(baked.report().warnings[0].ends_with("; the mesh is unwrapped anew"));
        test::expect_light(baked.texels(0), constant_pi);
        for (const double x : {0.001, 0.999, 1.7})
            EXPECT_NEAR(baked.irradiance_at(0, {x, 0, 1.3}), kPi, 0.1);
    }
}

TEST(LightmapLimits, ABakeWithoutLightWarns) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f);
    const BakedScene dark(scene, test::lightmap_settings(16));
    ASSERT_EQ(dark.report().warnings.size(), 1u);
    EXPECT_TRUE(dark.report().warnings[0].starts_with("no texel receives any light: "));
    scene.environment.radiance = glm::vec3(1e-6f);
    EXPECT_TRUE(BakedScene(scene, test::lightmap_settings(16)).report().warnings.empty());
}

TEST(LightmapLimits, APageThatIsTooSmallIsAnErrorWithTheSizeOfTheChart) {
    Scene scene = under_white_sky();
    test::add_floor(scene, kGrey, 1.0f).name = "small";
    test::add_quad(scene, kGrey, {0, 1, 0}, {0, 0, 5}, {10, 0, 0}).name = "large";
    BakeLightmapsSettings settings = test::lightmap_settings(16);
    settings.layout.page_size = 64;
    const auto baked = bake_lightmaps(scene, settings);
    ASSERT_FALSE(baked);
    const std::string error = error_text(baked.error());
    EXPECT_TRUE(error.starts_with("object \"large\": ")) << error;
    // 100 × 50 texels, and two on each side for filters.
    EXPECT_NE(error.find("104 × 54 texels"), std::string::npos) << error;
    EXPECT_NE(error.find("64"), std::string::npos) << error;
}

}  // namespace
}  // namespace tetralight
