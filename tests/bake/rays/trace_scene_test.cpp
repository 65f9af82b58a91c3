// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

TraceScene trace_scene(const Scene& scene) {
    auto result = TraceScene::make_static(scene);
    EXPECT_TRUE(result) << error_text(result.error());
    return std::move(*result);
}

/// What a vertical ray sees that comes from far above (or below) a place in the world.
std::optional<Surface> look_down(const TraceScene& scene, float x, float z, float from = 100.0f) {
    const glm::vec3 origin = scene.render_from_world(glm::dvec3(x, from, z));
    return scene.intersect({origin, {0.0f, from > 0.0f ? -1.0f : 1.0f, 0.0f}});
}

/// 2 x 2 texels: red, green over blue, white; of the alphas 0, 64 over 128, 255. Its row 0 is at
/// v = 0. Codes are 0 and 255, so that sRGB decoding is exact.
Texture four_colors() {
    Texture texture;
    texture.image = {
        2, 2, {{255, 0, 0, 0}, {0, 255, 0, 64}, {0, 0, 255, 128}, {255, 255, 255, 255}}};
    return texture;
}

/// A floor over [-1, 1]² whose u runs along +Z and v along +X, with the four colours.
Scene textured_floor() {
    Scene scene;
    scene.textures.push_back(four_colors());
    Material material = test::diffuse(glm::vec3(1.0f));
    material.base_color_texture.texture = 0;
    test::add_floor(scene, material, 1.0f);
    return scene;
}

TEST(TraceScene, RenderSpaceIsCenteredOnTheStaticScene) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 2.0f, 5.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 50.0f, 70.0f).contributes_gi = false;
    const TraceScene trace = trace_scene(scene);
    EXPECT_EQ(trace.render_from_world({0, 5, 0}), glm::vec3(0.0f));
    EXPECT_EQ(trace.world_from_render({1, 2, 3}), glm::dvec3(1, 7, 3));
}

TEST(TraceScene, LightsAreTransformedToRenderSpace) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 2.0f, 5.0f);
    Light& light = test::add_point_light(scene, LightMode::Mixed, glm::vec3(1.0f), {1, 6, 2});
    Light expected = light;
    expected.position = {1, 1, 2};
    EXPECT_EQ(trace_scene(scene).render_from_world(light), expected);
}

TEST(TraceScene, SurfacesHaveThePropertiesOfTheirMaterial) {
    Scene scene;
    Material material = test::diffuse({0.8f, 0.4f, 0.2f}, {1, 2, 3});
    material.metallic = 0.25f;
    material.roughness = 0.0f;
    test::add_floor(scene, material, 1.0f, 2.0f);
    const auto surface = look_down(trace_scene(scene), 0.5f, 0.25f);
    ASSERT_TRUE(surface);
    // Polished metal reflects nothing diffusely: albedo = color (1 − metallic).
    EXPECT_LT(glm::distance(surface->albedo, glm::vec3(0.6f, 0.3f, 0.15f)), 1e-6f);
    EXPECT_EQ(surface->emission, glm::vec3(1, 2, 3));
    EXPECT_LT(glm::distance(surface->position, glm::vec3(0.5f, 0, 0.25f)), 1e-5f);
    EXPECT_EQ(surface->geometric_normal, glm::vec3(0, 1, 0));
}

TEST(TraceScene, RoughMetalReflectsHalfOfItsColorDiffusely) {
    Scene scene;
    Material material;
    material.base_color = {0.8f, 0.4f, 0.2f, 1.0f};
    material.metallic = 1.0f;
    material.roughness = 1.0f;
    test::add_floor(scene, material, 1.0f);
    const auto surface = look_down(trace_scene(scene), 0, 0);
    EXPECT_LT(glm::distance(surface->albedo, glm::vec3(0.4f, 0.2f, 0.1f)), 1e-6f);
}

TEST(TraceScene, AppliesTheSurfaceSettingsOfTheBake) {
    Scene scene;
    test::add_floor(scene, test::diffuse({0.25f, 0.81f, 0.0f}), 1.0f);
    const auto trace = TraceScene::make_static(scene, {.albedo_boost = 2.0f, .max_albedo = 0.8f});
    ASSERT_TRUE(trace);
    // Square roots, of which 0.9 is too much.
    EXPECT_LT(glm::distance(look_down(*trace, 0, 0)->albedo, glm::vec3(0.5f, 0.8f, 0)), 1e-6f);
}

TEST(TraceScene, ExcludedEmissionIsVisibleButNotBaked) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(0.5f), {1, 2, 3});
    material.bakes_emission = false;
    test::add_floor(scene, material, 1.0f);
    EXPECT_EQ(look_down(trace_scene(scene), 0, 0)->emission, glm::vec3(0.0f));
    const auto seen = TraceScene::make(scene, [](const MeshInstance&) { return true; });
    ASSERT_TRUE(seen);
    EXPECT_EQ(look_down(*seen, 0, 0)->emission, glm::vec3(1, 2, 3));
}

TEST(TraceScene, UnlitMaterialsEmitTheirColorAndReflectNothing) {
    Scene scene = textured_floor();
    scene.materials[0].is_unlit = true;
    scene.materials[0].base_color = {0.5f, 0.5f, 0.5f, 1.0f};
    const auto surface = look_down(trace_scene(scene), -0.5f, 0.5f);
    EXPECT_LT(glm::distance(surface->emission, glm::vec3(0, 0.5f, 0)), 1e-5f);
    EXPECT_EQ(surface->albedo, glm::vec3(0.0f));
}

TEST(TraceScene, OnlyABackFaceOfASingleSidedMaterialIsOne) {
    for (const bool is_double_sided : {false, true}) {
        Scene scene;
        Material material = test::diffuse(glm::vec3(1.0f));
        material.is_double_sided = is_double_sided;
        test::add_floor(scene, material, 1.0f);
        const TraceScene trace = trace_scene(scene);
        EXPECT_FALSE(look_down(trace, 0, 0)->is_from_behind);
        EXPECT_FALSE(look_down(trace, 0, 0)->is_back_face);
        EXPECT_TRUE(look_down(trace, 0, 0, -100.0f)->is_from_behind);
        EXPECT_EQ(look_down(trace, 0, 0, -100.0f)->is_back_face, !is_double_sided);
    }
}

TEST(TraceScene, NormalsAreOnTheSideOfTheRay) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    const auto surface = look_down(trace_scene(scene), 0, 0, -100.0f);
    EXPECT_EQ(surface->geometric_normal, glm::vec3(0, -1, 0));
    EXPECT_EQ(surface->shading_normal, glm::vec3(0, -1, 0));
}

TEST(TraceScene, ExcludesMovingInstances) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f, 3.0f).contributes_gi = false;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    EXPECT_EQ(look_down(trace_scene(scene), 0, 0)->instance, 1u);
}

TEST(TraceScene, InstancesShareAMesh) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    MeshInstance copy = scene.instances[0];
    copy.world_from_mesh = glm::translate(glm::dmat4(1.0), glm::dvec3(10, 2, 0));
    scene.instances.push_back(copy);
    const TraceScene trace = trace_scene(scene);
    EXPECT_EQ(look_down(trace, 0, 0)->instance, 0u);
    EXPECT_EQ(look_down(trace, 10, 0)->instance, 1u);
    const glm::vec3 position = look_down(trace, 10, 0)->position;
    EXPECT_NEAR(trace.world_from_render(position).y, 2.0, 1e-5);
    EXPECT_FALSE(look_down(trace, 5, 0));
}

TEST(TraceScene, MirroredInstanceKeepsItsFront) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f).world_from_mesh =
        glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const auto surface = look_down(trace_scene(scene), 0.5f, 0);
    EXPECT_FALSE(surface->is_from_behind);
    EXPECT_EQ(surface->shading_normal, glm::vec3(0, 1, 0));
}

TEST(TraceScene, InstanceMirroredThroughItsPlaneFlipsItsFront) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f).world_from_mesh =
        glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1));
    const TraceScene trace = trace_scene(scene);
    EXPECT_TRUE(look_down(trace, 0, 0)->is_back_face);
    EXPECT_FALSE(look_down(trace, 0, 0, -100.0f)->is_back_face);
    EXPECT_EQ(look_down(trace, 0, 0, -100.0f)->shading_normal, glm::vec3(0, -1, 0));
}

TEST(TraceScene, NormalsAreCorrectUnderNonUniformScale) {
    // The plane x + y = 0 under x' = 2x is x'/2 + y' = 0: normal (1/2, 1, 0).
    Scene scene;
    test::add_quad(scene, test::diffuse(glm::vec3(1.0f)), {-1, 1, -1}, {0, 0, 2}, {2, -2, 0})
        .world_from_mesh = glm::scale(glm::dmat4(1.0), glm::dvec3(2, 1, 1));
    const auto surface = look_down(trace_scene(scene), 0.1f, 0.2f);
    ASSERT_TRUE(surface);
    const glm::vec3 expected = glm::normalize(glm::vec3(0.5f, 1.0f, 0.0f));
    EXPECT_LT(glm::distance(surface->geometric_normal, expected), 1e-6f);
    EXPECT_LT(glm::distance(surface->shading_normal, expected), 1e-6f);
}

TEST(TraceScene, ShadingNormalIsBlendedOverTheTriangle) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    Mesh& mesh = scene.meshes[0];
    for (size_t i = 0; i < 4; ++i)
        mesh.normals[i] = glm::normalize(mesh.positions[i] + glm::vec3(0, 1, 0));
    const auto surface = look_down(trace_scene(scene), 0, 0);
    // The diagonal runs through the middle, between normals that lean out by the same angle.
    EXPECT_LT(glm::distance(surface->shading_normal, glm::vec3(0, 1, 0)), 1e-5f);
    EXPECT_GT(look_down(trace_scene(scene), 0.9f, 0.8f)->shading_normal.x, 0.3f);
}

TEST(TraceScene, TextureIsSampledAtTheHit) {
    // u = (z + 1)/2, v = (x + 1)/2; texel centres are at 1/4 and 3/4.
    const Scene scene = textured_floor();
    const TraceScene trace = trace_scene(scene);
    EXPECT_LT(glm::distance(look_down(trace, -0.5f, -0.5f)->albedo, glm::vec3(1, 0, 0)), 1e-5f);
    EXPECT_LT(glm::distance(look_down(trace, -0.5f, 0.5f)->albedo, glm::vec3(0, 1, 0)), 1e-5f);
    EXPECT_LT(glm::distance(look_down(trace, 0.5f, -0.5f)->albedo, glm::vec3(0, 0, 1)), 1e-5f);
    EXPECT_LT(glm::distance(look_down(trace, 0.5f, 0.5f)->albedo, glm::vec3(1, 1, 1)), 1e-5f);
}

TEST(TraceScene, MirroredInstanceMirrorsItsTexture) {
    Scene scene = textured_floor();
    scene.instances[0].world_from_mesh = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const TraceScene trace = trace_scene(scene);
    EXPECT_LT(glm::distance(look_down(trace, 0.5f, 0.5f)->albedo, glm::vec3(0, 1, 0)), 1e-5f);
    EXPECT_LT(glm::distance(look_down(trace, -0.5f, -0.5f)->albedo, glm::vec3(0, 0, 1)), 1e-5f);
}

TEST(TraceScene, EmissionTextureHasItsOwnCoordinatesAndTransform) {
    Scene scene = textured_floor();
    Mesh& mesh = scene.meshes[0];
    for (const glm::vec2 uv : mesh.uvs[0]) mesh.uvs[1].emplace_back(uv.y, uv.x);
    Material& material = scene.materials[0];
    material.emission = glm::vec3(3.0f);
    material.emission_texture = {0, 1, glm::mat3(1.0f)};
    // Swapped axes: green is now where v = (x + 1)/2 is high in u, at (0.5, -0.5).
    EXPECT_LT(
        glm::distance(look_down(trace_scene(scene), 0.5f, -0.5f)->emission, glm::vec3(0, 3, 0)),
        1e-5f);
    material.emission_texture.image_from_mesh[2] = {0.5f, 0.0f, 1.0f};  // u + 1/2: to red
    EXPECT_LT(
        glm::distance(look_down(trace_scene(scene), 0.5f, -0.5f)->emission, glm::vec3(3, 0, 0)),
        1e-5f);
}

TEST(TraceScene, MaskLetsRaysThroughBelowItsCutoff) {
    // Alphas at the texel centres are 0, 0.25, 0.5 and 1.
    Scene scene = textured_floor();
    scene.materials[0].alpha_mode = AlphaMode::Mask;
    scene.materials[0].alpha_cutoff = 0.4f;
    const TraceScene trace = trace_scene(scene);
    EXPECT_FALSE(look_down(trace, -0.5f, -0.5f));
    EXPECT_FALSE(look_down(trace, -0.5f, 0.5f));
    EXPECT_TRUE(look_down(trace, 0.5f, -0.5f));
    EXPECT_TRUE(trace.occluded({{0.5f, 1, 0.5f}, {0, -1, 0}}));
    EXPECT_FALSE(trace.occluded({{-0.5f, 1, 0.5f}, {0, -1, 0}}));
}

TEST(TraceScene, OpaqueMaterialIgnoresAlpha) {
    const Scene scene = textured_floor();
    EXPECT_TRUE(look_down(trace_scene(scene), -0.5f, -0.5f));
}

TEST(TraceScene, BlendStopsTheFractionAlphaOfRays) {
    // Alpha is factor times texture: 0.6 · 0.5.
    Scene scene;
    scene.textures.push_back({"half", Image8{2, 1, {{0, 0, 0, 0}, {0, 0, 0, 255}}}});
    scene.textures[0].wrap_u = TextureWrap::Repeat;
    Material glass = test::diffuse(glm::vec3(0.0f));
    glass.base_color.a = 0.6f;
    glass.base_color_texture.texture = 0;
    glass.base_color_texture.image_from_mesh[0].x = 0.0f;  // everywhere between the two texels
    glass.alpha_mode = AlphaMode::Blend;
    test::add_floor(scene, glass, 1.0f);
    const TraceScene trace = trace_scene(scene);
    constexpr int kCount = 10000;
    int stopped = 0;
    for (int i = 0; i < kCount; ++i) {
        const float x = -0.9f + 1.8f * static_cast<float>(i) / kCount;
        const Ray ray{{x, 1.0f, 0.3f}, {0.0f, -1.0f, 0.0f}};
        const bool is_stopped = trace.intersect(ray).has_value();
        EXPECT_EQ(trace.occluded(ray), is_stopped);
        stopped += is_stopped;
    }
    // Binomial: σ = √(0.3 · 0.7 / 10000) = 0.0046; four of them.
    EXPECT_NEAR(stopped / static_cast<double>(kCount), 0.3, 0.0184);
}

/// Rays that leave a tilted square of this size where others met it, and meet it again.
int self_hits(double size) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(1.0f));
    material.is_double_sided = true;
    test::add_floor(scene, material, 1.0f).world_from_mesh = glm::scale(
        glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3))), glm::dvec3(size));
    const TraceScene trace = trace_scene(scene);
    std::mt19937_64 engine(5);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 direction = test::random_direction(engine);
        const auto surface = trace.intersect({-static_cast<float>(size) * direction, direction});
        if (!surface) continue;
        const glm::vec3 origin = TraceScene::ray_origin(*surface, surface->geometric_normal);
        for (const float slope : {1.0f, 1e-2f, 1e-4f}) {
            const glm::vec3 along = glm::cross(surface->geometric_normal, direction);
            hits += trace.occluded({origin, along + slope * surface->geometric_normal});
        }
    }
    return hits;
}

TEST(TraceScene, RaysThatLeaveASurfaceDoNotHitItAgainAtAnyScale) {
    for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6}) EXPECT_EQ(self_hits(size), 0) << size;
}

TEST(TraceScene, AVeryLargeGroundDoesNotOffsetRaysOverSmallObjects) {
    // A plate 3 mm above a tile, in a scene of 20 km: what leaves the tile is under the plate.
    Scene scene;
    const Material material = test::diffuse(glm::vec3(1.0f));
    test::add_floor(scene, material, 10000.0f, -1.0f);
    test::add_floor(scene, material, 0.5f);
    test::add_ceiling(scene, material, 0.5f, 0.003f);
    const TraceScene trace = trace_scene(scene);
    const auto surface =
        trace.intersect({trace.render_from_world({0.1, 0.002, 0.2}), glm::vec3(0, -1, 0)});
    ASSERT_TRUE(surface);
    const glm::vec3 up = surface->geometric_normal;
    EXPECT_TRUE(trace.occluded({TraceScene::ray_origin(*surface, up), up}));
}

TEST(TraceScene, PositionsLieOnTheTriangleHoweverLongTheRay) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    const TraceScene trace = trace_scene(scene);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 direction = glm::normalize(glm::vec3(static_cast<float>(i), -77, 13));
        const auto surface =
            trace.intersect({glm::vec3(0.1f, 0, 0.1f) - 5000.0f * direction, direction});
        ASSERT_TRUE(surface);
        EXPECT_EQ(surface->position.y, 0.0f);
    }
}

TEST(TraceScene, NamesAnInstanceThatIsTooFarAway) {
    Scene scene;
    test::add_box(scene, Material{}, test::Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    test::add_floor(scene, Material{}, 1.0f).world_from_mesh[3].x = 1e13;
    scene.instances[1].name = "lost";
    const auto trace = TraceScene::make_static(scene);
    ASSERT_FALSE(trace);
    EXPECT_TRUE(
        error_text(trace.error())
            .starts_with("instance 1 \"lost\": vertex 0 is 9999999999998 m from the center"))
        << error_text(trace.error());
}

TEST(TraceScene, WithoutGeometryRaysMiss) {
    const Scene scene;
    EXPECT_FALSE(look_down(trace_scene(scene), 0, 0));
}

/// A floor over [-1, 1]² with 64 × 64 texels in a checkerboard of white and black: 1/32 m each.
/// White is opaque and black is not.
Scene checkered_floor(AlphaMode mode) {
    Scene scene;
    Texture texture{"checkers", Image8{64, 64, {}}};
    for (int i = 0; i < 64 * 64; ++i) {
        const auto code = static_cast<uint8_t>((i % 64 + i / 64) % 2 == 0 ? 255 : 0);
        texture.image.pixels.push_back({code, code, code, code});
    }
    scene.textures.push_back(std::move(texture));
    Material material = test::diffuse(glm::vec3(0.96f));
    material.base_color_texture.texture = 0;
    material.alpha_mode = mode;
    test::add_floor(scene, material, 1.0f);
    return scene;
}

float albedo_below(const TraceScene& scene, float x, float z, float distance, float spread) {
    const auto surface =
        scene.intersect({{x, distance, z}, {0, -1, 0}}, TraceScene::Detail::LightOnly, spread);
    return surface ? surface->albedo.x : -1.0f;
}

TEST(TraceScene, AlbedoIsTheMeanOverTheConeOfTheRay) {
    const Scene scene = checkered_floor(AlphaMode::Opaque);
    const TraceScene trace = trace_scene(scene);
    const float x = 1.0f / 64.0f;  // center of a texel
    const float point = albedo_below(trace, x, x, 10.0f, 0.0f);
    EXPECT_TRUE(point == 0.96f || point == 0.0f);
    // A cone of 1.9 texels is not filtered, one of 2.1 texels is: by 2 × 2 texels.
    EXPECT_EQ(albedo_below(trace, x, x, 10.0f, 1.9f / 320.0f), point);
    EXPECT_NEAR(albedo_below(trace, x, x, 10.0f, 2.1f / 320.0f), 0.48f, 3e-4f);
    EXPECT_EQ(albedo_below(trace, x, x, 0.1f, 2.1f / 320.0f), point);
}

TEST(TraceScene, PicturesAreNotFiltered) {
    const Scene scene = checkered_floor(AlphaMode::Opaque);
    const auto trace = TraceScene::make(scene, [](const MeshInstance&) { return true; });
    ASSERT_TRUE(trace);
    const float x = 1.0f / 64.0f;
    EXPECT_EQ(albedo_below(*trace, x, x, 10.0f, 1.0f), albedo_below(*trace, x, x, 10.0f, 0.0f));
}

TEST(TraceScene, FilteringDoesNotMoveCutOuts) {
    const Scene scene = checkered_floor(AlphaMode::Mask);
    const TraceScene trace = trace_scene(scene);
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    int hit_count = 0;
    for (int i = 0; i < 1000; ++i) {
        const float x = coordinate(engine), z = coordinate(engine);
        const float point = albedo_below(trace, x, z, 10.0f, 0.0f);
        const float mean = albedo_below(trace, x, z, 10.0f, 0.125f);
        EXPECT_EQ(mean < 0.0f, point < 0.0f);
        if (mean < 0.0f) continue;
        ++hit_count;
        EXPECT_NEAR(mean, 0.96f, 5e-4f);  // what is cut out is not in the mean
    }
    EXPECT_NEAR(hit_count, 500, 60);
}

TEST(TraceScene, FilteredAlbedoHasVertexColorsAndSettings) {
    Scene scene = checkered_floor(AlphaMode::Opaque);
    scene.meshes[0].colors.assign(4, {0.5f, 0.25f, 1.0f, 1.0f});
    const Ray ray{{0.1f, 10.0f, 0.2f}, {0, -1, 0}};
    const auto albedo = [&](const SurfaceSettings& settings) {
        const auto trace = TraceScene::make_static(scene, settings);
        return trace->intersect(ray, TraceScene::Detail::LightOnly, 0.125f)->albedo;
    };
    EXPECT_LT(glm::distance(albedo({}), 0.48f * glm::vec3(0.5f, 0.25f, 1.0f)), 1e-3f);
    scene.meshes[0].colors.clear();
    // The mean of 0.4 and 0, and not the smaller one of 0.48 and 0.4.
    EXPECT_LT(glm::distance(albedo({.max_albedo = 0.4f}), glm::vec3(0.2f)), 1e-3f);
}

}  // namespace
}  // namespace tetralight
