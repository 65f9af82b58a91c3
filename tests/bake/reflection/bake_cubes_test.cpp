// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/bake_cubes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

BakeSettings samples(uint32_t count, uint32_t thread_count = 0) {
    BakeSettings settings;
    settings.sample_count = count;
    settings.thread_count = thread_count;
    return settings;
}

BakedCube bake(const Scene& scene, const CubePosition& position, uint32_t size,
               const BakeSettings& settings) {
    auto cubes = bake_cubes(scene, std::span(&position, 1), size, settings);
    EXPECT_TRUE(cubes) << error_text(cubes.error());
    return std::move(cubes->front());
}

/// A room with a lamp on one wall.
Scene lamp_room() {
    Scene scene;
    test::add_box(scene, test::diffuse({0.8f, 0.5f, 0.3f}), test::Facing::Inward, {-2, -2, -2},
                  {2, 2, 2});
    test::add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(20.0f)), test::Facing::Outward,
                  {-0.5, 1.5, -0.5}, {0.5, 1.9, 0.5});
    return scene;
}

TEST(BakeCubes, AConstantSkyIsInAllTexels) {
    Scene scene;
    scene.environment.radiance = {1.0f, 2.0f, 3.0f};
    const BakedCube cube = bake(scene, {}, 4, samples(2));
    ASSERT_EQ(cube.image.texels.size(), 96u);
    for (const glm::vec3& texel : cube.image.texels) EXPECT_EQ(texel, glm::vec3(1, 2, 3));
    EXPECT_EQ(cube.validity, 1.0f);
}

TEST(BakeCubes, EachFaceShowsItsSide) {
    // A lamp at one side at a time.
    for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
        glm::dvec3 center(0.0);
        center[static_cast<int>(face / 2)] = face % 2 == 0 ? 3.0 : -3.0;
        Scene scene;
        test::add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(5.0f)), test::Facing::Outward,
                      glm::vec3(center - 0.5), glm::vec3(center + 0.5));
        const BakedCube cube = bake(scene, {}, 3, samples(64));
        for (uint32_t other = 0; other < kCubeFaceCount; ++other) {
            // The near side of the lamp has a fifth of the width of its face, the middle texel of
            // three a third, so that 9/25 of its samples hit the lamp.
            const float seen = cube.image.texels[cube.image.index({other, 1, 1})].x;
            EXPECT_EQ(seen > 0.0f, face == other) << face << other;
        }
    }
}

TEST(BakeCubes, AnImageOfTheWallsIsAsLarge) {
    // A square lamp of half size 0.5 at distance 1: a texel of it is lit if its center is.
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(2.0f)), test::Facing::Outward,
                  {1, -0.5f, -0.5f}, {2, 0.5f, 0.5f});
    constexpr uint32_t kSize = 8;
    const BakedCube cube = bake(scene, {}, kSize, samples(4));
    for (size_t i = 0; i < cube.image.texels.size(); ++i) {
        const CubeTexel texel = cube.image.texel(i);
        const bool is_lit =
            texel.face == 0 && texel.x >= 2 && texel.x < 6 && texel.y >= 2 && texel.y < 6;
        EXPECT_EQ(cube.image.texels[i], glm::vec3(is_lit ? 2.0f : 0.0f)) << i;
    }
}

TEST(BakeCubes, SurfacesShowReflectedLightOfAMixedSunAndNotTheSun) {
    // A floor of albedo 0.5 under a sun of irradiance π at its zenith has radiance 0.5.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 100.0f, -1.0f);
    Light sun;
    sun.mode = LightMode::Mixed;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(std::numbers::pi_v<float>);
    scene.lights.push_back(sun);
    scene.light_names.emplace_back("sun");
    for (const LightMode mode : {LightMode::Mixed, LightMode::Baked}) {
        scene.lights[0].mode = mode;
        const BakedCube cube = bake(scene, {}, 4, samples(4));
        const glm::vec3 down = cube.image.texels[cube.image.index({3, 1, 1})];
        EXPECT_NEAR(down.x, 0.5f, 1e-5f);
        EXPECT_EQ(cube.image.texels[cube.image.index({2, 1, 1})], glm::vec3(0.0f));
    }
}

TEST(BakeCubes, NearerSurfacesThanTheNearDistanceAreNotSeen) {
    const Scene scene = lamp_room();
    const auto up = [&](float near_distance) {
        const BakedCube cube = bake(scene, {{0, 0, 0}, near_distance}, 8, samples(4));
        return cube.image.texels[cube.image.index({2, 4, 4})].x;
    };
    EXPECT_GT(up(0.0f), 19.0f);
    EXPECT_LT(up(1.95f), 19.0f);  // between the lamp and the ceiling
}

TEST(BakeCubes, ObjectsThatAreNotInReflectionsStillGiveLight) {
    Scene scene = lamp_room();
    scene.materials[0] = test::diffuse(glm::vec3(0.1f));
    scene.instances[1].is_in_reflections = false;
    const BakedCube cube = bake(scene, {}, 8, samples(16));
    float brightest = 0.0f, darkest = std::numeric_limits<float>::infinity();
    for (const glm::vec3& texel : cube.image.texels) {
        brightest = std::max(brightest, texel.x);
        darkest = std::min(darkest, texel.x);
    }
    // The ceiling right above the lamp has up to a tenth of its radiance.
    EXPECT_LT(brightest, 3.0f);
    EXPECT_GT(darkest, 0.0f);
}

TEST(BakeCubes, TheLightIsThatOfALightProbe) {
    const Scene scene = lamp_room();
    const glm::dvec3 position(0.3, -0.4, 0.2);
    const BakedCube cube = bake(scene, {position}, 32, samples(64));
    const auto probe = bake_probes(scene, std::span(&position, 1), samples(65536));
    ASSERT_TRUE(probe);
    const RadianceSh a = project_cube(cube.image), b = probe->radiance[0];
    // Both have a noise of about 0.2 % of the mean light, the cube's texels an error of 2e-4.
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(a.coefficients[i][channel], b.coefficients[i][channel],
                        0.01f * b.coefficients[0][channel]);
        }
    }
    EXPECT_EQ(cube.validity, 1.0f);
}

TEST(BakeCubes, InsideASolidValidityIsZero) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(1.0f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    EXPECT_EQ(bake(scene, {}, 4, samples(1)).validity, 0.0f);
}

TEST(BakeCubes, SameBitsForAnyNumberOfThreadsAndOtherPositions) {
    const Scene scene = lamp_room();
    const CubePosition positions[] = {{{0.5, 0.5, 0.5}}, {{-1.0, 0.0, 1.0}, 0.25f}};
    const auto one = bake_cubes(scene, positions, 8, samples(4, 1));
    const auto two = bake_cubes(scene, positions, 8, samples(4, 2));
    ASSERT_TRUE(one && two);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ((*one)[i].image, (*two)[i].image);
    EXPECT_EQ(bake(scene, positions[1], 8, samples(4)).image, (*one)[1].image);
}

TEST(BakeCubes, RefusesPositionsThatAreNotFinite) {
    const CubePosition position{{0.0, std::nan(""), 0.0}};
    const auto cubes = bake_cubes(lamp_room(), std::span(&position, 1), 4, samples(1));
    ASSERT_FALSE(cubes);
    EXPECT_EQ(error_text(cubes.error()), "reflection probe 0: position is not finite");
}

TEST(BakeCubes, EndsWhenTheCallbackSaysSo) {
    const CubePosition position;
    const auto cubes = bake_cubes(lamp_room(), std::span(&position, 1), 64, samples(64),
                                  [](const BakeProgress&) { return false; });
    ASSERT_FALSE(cubes);
    EXPECT_EQ(cubes.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace tetralight
