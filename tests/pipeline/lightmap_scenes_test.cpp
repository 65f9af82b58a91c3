// SPDX-License-Identifier: Apache-2.0
// Whole bakes of scenes that are known to go wrong in lightmaps. The light of each has a closed
// form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "tests/pipeline/baked_scene.h"
#include "tests/support/rooms.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

using test::BakedScene;
using test::SampledTexel;

constexpr double kPi = std::numbers::pi;

const Material kBlack = test::diffuse(glm::vec3(0.0f));
const Material kGrey = test::diffuse(glm::vec3(0.5f));

Scene under_white_sky() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    return scene;
}

double constant_pi(const glm::dvec3&) {
    return kPi;
}

/// Expects bilinear light at a place beside edges to lie between the least and the largest light of
/// the texels that it reads.
template <class LightAt>
void expect_between(double value, const LightAt& light, glm::dvec2 low, glm::dvec2 high) {
    double least = 1e9, most = -1e9;
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i) {
        for (int k = 0; k <= kSteps; ++k) {
            const double e = light(glm::mix(low, high, glm::dvec2(i, k) / double{kSteps}));
            least = std::min(least, e);
            most = std::max(most, e);
        }
    }
    constexpr double kNoise = 0.15;
    EXPECT_GE(value, least - kNoise) << low.x << ' ' << low.y;
    EXPECT_LE(value, most + kNoise) << low.x << ' ' << low.y;
}

TEST(LightmapScenes, ABoxInTheCornerOfARoomDarkensNothingBeyondItsShadow) {
    // Walls of radiance 1 and a black box whose faces lie in them.
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), test::Facing::Inward,
                  {0, 0, 0}, {2, 2, 2});
    const glm::dvec3 low(0.0), high(1.03, 1.0, 0.97);
    test::add_box(scene, kBlack, test::Facing::Outward, glm::vec3(low), glm::vec3(high));
    const BakedScene baked(scene, test::lightmap_settings(256));
    const auto light = [&](double x, double z) {
        return kPi - test::irradiance_of_sides({x, 0, z}, low, high);
    };
    for (const double t : {0.15, 0.33, 0.52, 0.71}) {
        expect_between(baked.irradiance_at(0, {high.x + 1e-3, 0, t}),
                       [&](glm::dvec2 p) { return light(p.x, p.y); }, {high.x + 1e-4, t - 0.1},
                       {high.x + 0.15, t + 0.1});
        expect_between(baked.irradiance_at(0, {t, 0, high.z + 1e-3}),
                       [&](glm::dvec2 p) { return light(p.x, p.y); }, {t - 0.1, high.z + 1e-4},
                       {t + 0.1, high.z + 0.15});
    }
    // Its top sees nothing but walls.
    for (const double x : {1e-3, 0.5, 1.029})
        EXPECT_NEAR(baked.irradiance_at(1, {x, 1, 0.4}), kPi, 0.15);
}

/// 3 × 3 tiles of one mesh, 1 m each.
Scene tiles(Scene scene, const Material& material) {
    const size_t first = scene.instances.size();
    for (int i = 0; i < 9; ++i) {
        if (i == 0) {
            test::add_floor(scene, material, 0.5f);
        } else {
            scene.instances.push_back(scene.instances[first]);
        }
        scene.instances.back().world_from_mesh =
            glm::translate(glm::dmat4(1.0), glm::dvec3(i % 3, 0, i / 3));
    }
    return scene;
}

TEST(LightmapScenes, TilesUnderAWhiteSkyAreOneWhiteFloor) {
    const BakedScene baked(tiles(under_white_sky(), kGrey), test::lightmap_settings(128));
    for (uint32_t i = 0; i < 9; ++i) test::expect_light(baked.texels(i), constant_pi);
    EXPECT_EQ(baked.report().invalid_count, 0u);
}

TEST(LightmapScenes, TilesUnderALampMeetWithoutADifference) {
    Scene scene = tiles({}, kBlack);
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(9.0f)), 0.3f, 0.5f);
    const BakedScene baked(scene, test::lightmap_settings(128));
    EXPECT_EQ(baked.report().seam_count, 12u);
    EXPECT_LE(baked.report().seam_difference, 0.01f);
    EXPECT_LE(baked.report().seam_difference, 0.25f * baked.report().seam_difference_baked);
    const double bright = baked.irradiance_at(0, {0, 0, 0});
    for (const double z : {-0.3, 0.1, 0.6, 1.4}) {
        const auto tile = static_cast<uint32_t>(std::lround(z)) * 3;
        EXPECT_NEAR(baked.irradiance_at(tile, {0.5, 0, z}),
                    baked.irradiance_at(tile + 1, {0.5, 0, z}), 0.01 * bright);
    }
}

/// A sphere of radius 1 with smooth normals.
Mesh sphere(int sides) {
    Mesh mesh;
    const int rings = sides / 2;
    for (int ring = 0; ring <= rings; ++ring) {
        for (int i = 0; i < sides; ++i) {
            const double polar = kPi * ring / rings, turn = 2.0 * kPi * i / sides;
            const glm::dvec3 p(std::sin(polar) * std::sin(turn), std::cos(polar),
                               std::sin(polar) * std::cos(turn));
            mesh.positions.emplace_back(p);
            mesh.normals.emplace_back(p);
        }
    }
    const auto at = [&](int ring, int i) {
        return static_cast<uint32_t>(ring * sides + i % sides);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int i = 0; i < sides; ++i) {
            for (const uint32_t k : {at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)})
                mesh.indices.push_back(k);
            for (const uint32_t k : {at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)})
                mesh.indices.push_back(k);
        }
    }
    return mesh;
}

/// The side of a cylinder of radius 1 around the Y axis with smooth normals.
Mesh cylinder(int sides) {
    Mesh mesh;
    for (int i = 0; i < sides; ++i) {
        const double turn = 2.0 * kPi * i / sides;
        const glm::vec3 normal(std::sin(turn), 0, std::cos(turn));
        for (const float y : {0.0f, 1.0f}) {
            mesh.positions.push_back(normal + glm::vec3(0, y, 0));
            mesh.normals.push_back(normal);
        }
    }
    const auto count = static_cast<uint32_t>(2 * sides);
    for (uint32_t a = 0; a < count; a += 2) {
        const uint32_t b = a + 1, c = (a + 2) % count, d = (a + 3) % count;
        for (const uint32_t k : {a, c, b, b, c, d}) mesh.indices.push_back(k);
    }
    return mesh;
}

/// A sun on a round body, which shades itself where it faces away and nowhere else.
void expect_smooth_sun(Mesh mesh) {
    Scene scene;
    test::add_mesh(scene, kBlack, std::move(mesh));
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(1.0, 0.3, 0.5));
    test::add_sun(scene, LightMode::Baked, glm::vec3(3.0f)).direction = glm::vec3(-to_sun);
    const BakedScene baked(scene, test::lightmap_settings(16));
    EXPECT_GE(baked.report().seam_count, 4u);
    EXPECT_LE(baked.worst_seam(), 0.01 * 3.0);
    const PreparedLightmaps& prepared = baked.prepared();
    const auto texels = baked.texels(0);
    ASSERT_EQ(texels.size(), prepared.baked.size());
    size_t off_count = 0;
    for (size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 normal(prepared.surfaces[i].normal);
        const double expected = 3.0 * std::max(0.0, glm::dot(normal, to_sun));
        EXPECT_NEAR(texels[i].irradiance, expected, 0.3);
        off_count += std::abs(texels[i].irradiance - expected) > 0.1;
    }
    EXPECT_LE(off_count, texels.size() / 50);
}

TEST(LightmapScenes, ASphereUnderASunFollowsItsNormals) {
    expect_smooth_sun(sphere(32));
}

TEST(LightmapScenes, ACylinderUnderASunFollowsItsNormals) {
    expect_smooth_sun(cylinder(32));
}

/// Two rooms with a wall without thickness between them, of which only one has a lamp. The wall is
/// a quad whose front is in the dark, or in the light.
void expect_dark_room(bool is_front_dark) {
    Scene scene = test::two_rooms(0.0f);
    if (!is_front_dark) {
        auto& indices = scene.meshes[1].indices;
        std::ranges::reverse(indices);
        for (glm::vec3& normal : scene.meshes[1].normals) normal = -normal;
    }
    const BakedScene baked(scene, test::lightmap_settings(64, 4.0));
    const double bright = baked.irradiance_at(0, {-2, 0, 2});
    EXPECT_GT(bright, 1.0);
    // The texels at the wall have the light of one side.
    for (const SampledTexel& texel : baked.texels(0)) {
        const double x = texel.position.x;
        if (std::abs(x) < 0.25) continue;
        EXPECT_EQ(texel.irradiance > 1e-3 * bright, x < 0.0) << x;
    }
    for (const SampledTexel& texel : baked.texels(1))
        EXPECT_EQ(texel.irradiance > 1e-3 * bright, !is_front_dark);
}

TEST(LightmapScenes, AWallWithoutThicknessKeepsADarkRoomDark) {
    expect_dark_room(true);
    expect_dark_room(false);
}

/// A black floor of 2 m with a black box that is sunk in it.
struct SunkBox {
    glm::dvec3 low{-0.53, -0.47, -0.53}, high{0.53, 1.0, 0.53};
    BakedScene baked{scene(), test::lightmap_settings(256)};

    [[nodiscard]] Scene scene() const {
        Scene scene = under_white_sky();
        test::add_floor(scene, kBlack, 1.0f);
        test::add_box(scene, kBlack, test::Facing::Outward, glm::vec3(low), glm::vec3(high));
        return scene;
    }

    /// Light on the floor, outside the box.
    [[nodiscard]] double on_floor(glm::dvec2 p) const {
        return kPi - test::irradiance_of_sides({p.x, 0, p.y}, low, high);
    }

    /// Light on the side x = 0.53, above the floor: the sky, also below the horizon, without the
    /// floor in front of the side.
    [[nodiscard]] double on_side(glm::dvec2 p) const {
        const double x = high.x;
        return kPi - test::polygon_irradiance({x, p.x, p.y}, {1, 0, 0},
                                              {{x, 0, -1}, {x, 0, 1}, {1, 0, 1}, {1, 0, -1}});
    }
};

TEST(LightmapScenes, TexelsUnderABoxDarkenNoFloorBesideIt) {
    const SunkBox box;
    test::expect_light(box.baked.texels(0), [&](glm::dvec3 p) { return box.on_floor({p.x, p.z}); });
    for (const double z : {-0.45, -0.2, 0.0, 0.31, 0.5}) {
        const auto on_floor = [&](glm::dvec2 p) { return box.on_floor(p); };
        expect_between(box.baked.irradiance_at(0, {0.531, 0, z}), on_floor, {0.5301, z - 0.15},
                       {0.68, z + 0.15});
        expect_between(box.baked.irradiance_at(0, {-0.531, 0, z}), on_floor, {-0.68, z - 0.15},
                       {-0.5301, z + 0.15});
    }
}

TEST(LightmapScenes, HalfBuriedTexelsHaveTheLightAboveTheFloor) {
    const SunkBox box;
    for (const double z : {-0.4, -0.13, 0.0, 0.22, 0.41}) {
        for (const double y : {0.002, 0.03, 0.06}) {
            expect_between(box.baked.irradiance_at(1, {0.53, y, z}),
                           [&](glm::dvec2 p) { return box.on_side(p); }, {1e-3, z - 0.1},
                           {0.16, z + 0.1});
        }
    }
}

TEST(LightmapScenes, TwoSidedLeavesAreValid) {
    Scene scene = under_white_sky();
    test::add_floor(scene, kGrey, 2.0f);
    Material leaf = test::diffuse(glm::vec3(0.3f));
    leaf.is_double_sided = true;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto vector = [&] {
        return glm::vec3(uniform(random), uniform(random), uniform(random));
    };
    Mesh bush;
    for (int i = 0; i < 60; ++i) {
        const glm::vec3 u = glm::normalize(vector()), v = glm::normalize(glm::cross(u, vector()));
        test::append_quad(bush, 0.5f * vector() + glm::vec3(0, 0.8f, 0), 0.25f * u, 0.25f * v);
    }
    test::add_mesh(scene, leaf, std::move(bush));
    const BakedScene baked(scene, test::lightmap_settings(64));
    EXPECT_EQ(baked.report().invalid_count, 0u);
    // Only in the creases where leaves cross it is dark.
    const auto leaves = baked.texels(1);
    const auto dark_count = std::ranges::count_if(
        leaves, [](const SampledTexel& texel) { return texel.irradiance < 0.03 * kPi; });
    EXPECT_LE(static_cast<size_t>(dark_count), leaves.size() / 100);
}

/// A large pane close above a black floor, whose front is up or down, or both.
void expect_blended(float opacity, bool is_front_up, bool is_double_sided) {
    Scene scene = under_white_sky();
    test::add_floor(scene, kBlack, 0.5f);
    Material pane = kBlack;
    pane.base_color.a = opacity;
    pane.alpha_mode = AlphaMode::Blend;
    pane.is_double_sided = is_double_sided;
    MeshInstance& object = is_front_up ? test::add_floor(scene, pane, 50.0f, 0.05f)
                                       : test::add_ceiling(scene, pane, 50.0f, 0.05f);
    object.lightmap.scale = 0.05f;
    test::add_sun(scene, LightMode::Baked, glm::vec3(2.0f));
    const BakedScene baked(scene, test::lightmap_settings(256));
    EXPECT_EQ(baked.report().invalid_count, 0u);
    // The sun is at the zenith.
    const double passed = 1.0 - double{opacity};
    test::expect_light(baked.texels(0), [&](glm::dvec3) { return passed * (kPi + 2.0); });
    if (!is_front_up) return;
    test::expect_light(baked.texels(1), [](glm::dvec3) { return kPi + 2.0; });
}

TEST(LightmapScenes, BlendedQuadsPassLightByTheirOpacity) {
    for (const float opacity : {0.25f, 0.9f}) {
        expect_blended(opacity, true, true);
        expect_blended(opacity, true, false);
        expect_blended(opacity, false, false);
    }
}

TEST(LightmapScenes, ErrorBarsAreThoseOfFilteredLight) {
    // Light of a panel varies over the floor.
    Scene scene;
    test::add_floor(scene, kBlack, 3.0f);
    const glm::dvec3 low(-1.0, 2.0, -1.0), high(1.0, 2.0, 1.0);
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(10.0f)), 1.0f, 2.0f);
    scene.instances[1].lightmap.scale = 0.0f;
    const BakedScene baked(scene, test::lightmap_settings(128));
    double told = 0.0, own = 0.0, error = 0.0;
    for (const SampledTexel& texel : baked.texels(0)) {
        double light = 0.0;
        for (const glm::dvec3& place : texel.places) {
            light += 10.0 *
                     test::polygon_irradiance(place, {0, 1, 0},
                                              {low, {low.x, 2, high.z}, high, {high.x, 2, low.z}}) /
                     static_cast<double>(texel.places.size());
        }
        told += texel.error * texel.error;
        own += texel.own_error * texel.own_error;
        error += std::pow(texel.irradiance - light, 2);
    }
    EXPECT_LT(error, own / 2.0);
    EXPECT_LT(told, 1.5 * 1.5 * error);
    EXPECT_GT(told, error / (1.5 * 1.5));
}

TEST(LightmapScenes, ErrorBarsOfDarkTexelsAreAtMostOne) {
    // The lamp lights a spot of the ceiling that few of the paths hit.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 3.0f);
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.5f)), 3.0f, 1.0f);
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(10.0f), {0, 0.9, 0}).range = 0.15f;
    const BakedScene baked(scene, test::lightmap_settings(64));
    size_t noisy = 0;
    for (const SampledTexel& texel : baked.texels(0)) {
        if (!(texel.irradiance > 0.0)) continue;
        EXPECT_LE(texel.error, texel.irradiance * 1.001);
        noisy += texel.error > 0.5 * texel.irradiance;
    }
    EXPECT_GT(noisy, 0u);
}

TEST(LightmapScenes, MirroredInstancesHaveMirroredLight) {
    Scene scene = under_white_sky();
    Mesh corner;  // a floor and a wall, as seen from x > 0
    test::append_quad(corner, {0, 0, 0}, {0, 0, 1}, {1.5f, 0, 0});
    test::append_quad(corner, {1.5f, 0, 0}, {0, 0, 1}, {0, 0.8f, 0});
    test::add_mesh(scene, kGrey, std::move(corner));
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].world_from_mesh = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    test::add_sun(scene, LightMode::Baked, glm::vec3(2.0f)).direction =
        glm::normalize(glm::vec3(0, -1, 0.4f));
    const BakedScene baked(scene, test::lightmap_settings(256));
    EXPECT_EQ(baked.report().invalid_count, 0u);
    EXPECT_EQ(baked.prepared().layout.packings.size(), 1u);
    const auto plain = baked.texels(0), mirrored = baked.texels(1);
    ASSERT_EQ(plain.size(), mirrored.size());
    for (size_t i = 0; i < plain.size(); ++i) {
        const glm::dvec3 image = plain[i].position * glm::dvec3(-1, 1, 1);
        EXPECT_LE(glm::distance(image, mirrored[i].position), 1e-6);
        EXPECT_GT(plain[i].irradiance, 1.0);
        const double error = std::hypot(plain[i].error, mirrored[i].error);
        EXPECT_NEAR(plain[i].irradiance, mirrored[i].irradiance, 6.0 * error + 0.02);
    }
}

TEST(LightmapScenes, AnEmissiveCubeOfOneTexelLightsTheFloor) {
    Scene scene;
    test::add_floor(scene, kBlack, 1.0f);
    const glm::dvec3 low(-0.05, 0.3, -0.05), high(0.05, 0.4, 0.05);
    test::add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(100.0f)), test::Facing::Outward,
                  glm::vec3(low), glm::vec3(high));
    const BakedScene baked(scene, test::lightmap_settings(256));
    const auto& charts = baked.prepared().layout.packings[1].charts;
    EXPECT_LE(charts.width * charts.height, 6u * 6u * 6u);
    test::expect_light(baked.texels(0), [&](glm::dvec3 p) {
        const double below = test::polygon_irradiance(p, {0, 1, 0},
                                                      {{low.x, low.y, low.z},
                                                       {low.x, low.y, high.z},
                                                       {high.x, low.y, high.z},
                                                       {high.x, low.y, low.z}});
        return 100.0 * (below + test::irradiance_of_sides(p, low, high));
    });
    for (const SampledTexel& texel : baked.texels(1)) EXPECT_EQ(texel.irradiance, 0.0);
}

}  // namespace
}  // namespace tetralight
