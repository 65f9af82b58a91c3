// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/sample_reflections.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

using test::box_probe;
using test::make_random_reflections;
using test::make_reflections;
using test::random_unit_vector;

glm::vec3 stored(const RadianceTexel& texel) {
    return {float_from_half(texel[0]), float_from_half(texel[1]), float_from_half(texel[2])};
}

TEST(SampleCube, GivesTexelsAtTheirCenters) {
    const Reflections cubes = make_random_reflections(8, 1, {{}, {}});
    for (uint32_t i = 0; i < 6 * 64; ++i) {
        const glm::vec3 direction = cube_direction(CubeTexel{i / 64, i % 8, i / 8 % 8}, 8);
        EXPECT_LT(glm::distance(sample_cube(cubes.view(), 1, 2.0f * direction, 0.0f),
                                stored(cubes.levels[0][6 * 64 + i])),
                  1e-4f);
    }
}

TEST(SampleCube, IsLinearBetweenLevels) {
    const Reflections cubes =
        make_reflections(16, 3, {{}}, [](uint32_t, uint32_t level, const glm::vec3&) {
            return glm::vec3(static_cast<float>(level) + 1.0f);
        });
    for (const float roughness : {0.0f, 0.1f, 0.5f, 0.8f, 1.0f}) {
        const glm::vec3 light = sample_cube(cubes.view(), 0, {0.3f, -1.0f, 0.9f}, roughness);
        EXPECT_NEAR(light.x, 1.0f + 2.0f * roughness * (2.0f - roughness), 1e-5f);
    }
}

TEST(SampleCube, IsBilinear) {
    // Along a row of a face a linear function of u is reproduced between the centers of texels.
    const Reflections cubes = make_reflections(
        8, 1, {{}},
        [](uint32_t, uint32_t, const glm::vec3& d) { return glm::vec3(cube_place(d).uv, 1.0f); });
    for (float u = 0.1f; u < 0.9f; u += 0.03f) {
        const glm::vec2 uv(u, 0.9f - 0.9f * u + 0.05f);
        const glm::vec3 light =
            sample_cube(cubes.view(), 0, cube_direction(CubePlace{3, uv}), 0.0f);
        EXPECT_LT(glm::distance(glm::vec2(light), uv), 1e-3f) << u;
    }
}

/// Texels lie in [0, 1], so that a step by `distance` in direction, which is at most 3 n / 2
/// distance texels near an edge or a corner, changes a sample by at most twice as much.
TEST(SampleCube, HasNoStepAtEdgesAndCorners) {
    constexpr float kDistance = 1e-5f, kSize = 8.0f;
    const Reflections cubes = make_random_reflections(8, 1, {{}});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (int i = 0; i < 20'000; ++i) {
        const float sign = i & 1 ? 1.0f : -1.0f;
        glm::vec3 place(1.0f, sign, i % 5 == 0 ? -1.0f : unit(random));
        std::rotate(&place.x, &place.x + i % 3, &place.x + 3);
        if (i & 2) place = -place;
        const glm::vec3 step = 0.5f * kDistance * random_unit_vector(random);
        const glm::vec3 a = sample_cube(cubes.view(), 0, place + step, 0.0f);
        const glm::vec3 b = sample_cube(cubes.view(), 0, place - step, 0.0f);
        ASSERT_LT(glm::length(a - b), 2.0f * 1.5f * kSize * kDistance * 1.8f) << i;
    }
}

TEST(SampleCube, TexelsThatAreNotThereAreBlack) {
    const Reflections cubes = make_random_reflections(8, 2, {{}, {}});
    ReflectionsView view = cubes.view();
    EXPECT_EQ(sample_cube(view, 2, {1, 0, 0}, 0.0f), glm::vec3(0.0f));
    EXPECT_EQ(sample_cube(view, UINT32_MAX, {1, 0, 0}, 0.7f), glm::vec3(0.0f));
    view.levels[1] = view.levels[1].first(view.levels[1].size() - 1);
    EXPECT_EQ(sample_cube(view, 1, {1, 0, 0}, 1.0f), glm::vec3(0.0f));
    EXPECT_NE(sample_cube(view, 0, {1, 0, 0}, 1.0f), glm::vec3(0.0f));
    view.level_count = 100;
    EXPECT_EQ(sample_cube(view, 0, {1, 0, 0}, 1.0f), glm::vec3(0.0f));
    view.size = UINT32_MAX;
    EXPECT_EQ(sample_cube(view, 0, {1, 0, 0}, 0.0f), glm::vec3(0.0f));
    EXPECT_EQ(sample_cube({}, 0, {1, 0, 0}, 0.5f), glm::vec3(0.0f));
}

TEST(SampleCube, DirectionsThatAreNotFiniteGiveFiniteLight) {
    const Reflections cubes = make_random_reflections(8, 2, {{}});
    for (const float x : {0.0f, std::nanf(""), HUGE_VALF}) {
        const glm::vec3 light = sample_cube(cubes.view(), 0, {x, x, 0.0f}, std::nanf(""));
        EXPECT_TRUE(std::isfinite(light.x + light.y + light.z));
    }
}

TEST(ProjectOnBox, LooksAtWhereTheRayHitsTheWall) {
    const ReflectionProbe probe = box_probe({0, 0, 0}, {2, 1, 3});
    const auto expect = [&](glm::dvec3 position, glm::vec3 direction, glm::vec3 hit) {
        EXPECT_LT(glm::distance(project_on_box(probe, position, direction), glm::normalize(hit)),
                  1e-6f);
    };
    expect({1, 0, 0}, {0, 0, 1}, {1, 0, 3});
    expect({1, 0, 0}, {5, 0, 0}, {2, 0, 0});
    expect({1, 0.5, -1}, {0, -2, 0}, {1, -1, -1});
    expect({-1, 0, 0}, {1, 0, 1}, {2, 0, 3});  // the edge
    expect({0, 0, -3}, {0, 0, 1}, {0, 0, 3});  // from one wall to the other
}

TEST(ProjectOnBox, AtTheProbeIsTheDirection) {
    std::mt19937 random(4);
    ReflectionProbe probe = box_probe({3, 4, 5}, {2, 1, 3});
    probe.box_center = {0.5f, -0.5f, 1.0f};
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 direction = random_unit_vector(random);
        EXPECT_LT(glm::distance(project_on_box(probe, probe.position, 3.0f * direction), direction),
                  1e-6f);
    }
}

/// A box at any angle, a place inside it, and the position of a probe inside it.
struct BoxCase {
    ReflectionProbe probe;
    glm::dvec3 position{0.0};

    BoxCase(std::mt19937& random, const glm::dvec3& origin) {
        std::uniform_real_distribution<float> size(0.5f, 4.0f), inside(-0.95f, 0.95f);
        const glm::mat3 axes = test::random_axes(random);
        probe.half_size = {size(random), size(random), size(random)};
        probe.axes = {axes[0], axes[1], axes[2]};
        const auto place = [&] {
            return axes *
                   (probe.half_size * glm::vec3(inside(random), inside(random), inside(random)));
        };
        const glm::vec3 of_probe = place();  // relative to the center
        probe.position = origin;
        probe.box_center = -of_probe;
        position = origin + glm::dvec3(place() - of_probe);
    }

    /// Where a ray from inside leaves the box, relative to the probe, by bisection.
    [[nodiscard]] glm::dvec3 exit(const glm::dvec3& from, const glm::dvec3& along) const {
        double inside = 0.0, outside = 100.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (inside + outside);
            const glm::dvec3 place = from + middle * along - glm::dvec3(probe.box_center);
            bool is_inside = true;
            for (int axis = 0; axis < 3; ++axis) {
                const glm::dvec3 direction(probe.axes[static_cast<size_t>(axis)]);
                is_inside &= std::abs(glm::dot(place, direction)) <= probe.half_size[axis];
            }
            (is_inside ? inside : outside) = middle;
        }
        return from + inside * along;
    }
};

TEST(ProjectOnBox, WorksInBoxesAtAnyAngle) {
    std::mt19937 random(5);
    for (int i = 0; i < 2000; ++i) {
        const BoxCase box(random, {1, 2, 3});
        const glm::vec3 direction = random_unit_vector(random);
        const glm::dvec3 hit = box.exit(box.position - box.probe.position, direction);
        const glm::vec3 found = project_on_box(box.probe, box.position, direction);
        ASSERT_LT(glm::distance(found, glm::vec3(glm::normalize(hit))), 1e-5f) << i;
    }
}

TEST(ProjectOnBox, IsAsExactFarFromTheOrigin) {
    std::mt19937 near_random(6), far_random(6);
    std::mt19937 random(7);
    for (int i = 0; i < 1000; ++i) {
        const BoxCase near(near_random, {0, 0, 0}), far(far_random, {1e6, -2e6, 1e6});
        const glm::vec3 direction = random_unit_vector(random);
        ASSERT_LT(glm::distance(project_on_box(near.probe, near.position, direction),
                                project_on_box(far.probe, far.position, direction)),
                  1e-6f);
    }
}

TEST(ProjectOnBox, LeavesDirectionsOutsideTheBoxAndOfTheSky) {
    const ReflectionProbe box = box_probe({0, 0, 0}, {2, 1, 3});
    const glm::vec3 direction(0.0f, 0.6f, 0.8f);
    EXPECT_EQ(project_on_box(box, {3, 0, 0}, direction), direction);
    EXPECT_EQ(project_on_box(ReflectionProbe{}, {3, 0, 0}, direction), direction);
}

TEST(ProjectOnBox, WallsOnTheSidesAreInside) {
    // One rounding apart in floats far from the origin, and on either side of the wall.
    const ReflectionProbe box = box_probe({0, 0, 0}, {2, 1, 3});
    const glm::vec3 inward(-0.6f, 0.8f, 0.0f), outward(1.0f, 0.0f, 0.0f);
    const glm::vec3 hit = glm::normalize(glm::vec3(1.25f, 1.0f, 1.0f));
    for (const double x : {1.999, 2.0, 2.001}) {
        EXPECT_LT(glm::distance(project_on_box(box, {x, 0, 1}, inward), hit), 1e-3f) << x;
        EXPECT_LT(glm::distance(project_on_box(box, {x, 0, 1}, outward),
                                glm::normalize(glm::vec3(2, 0, 1))),
                  1e-3f)
            << x;
    }
}

TEST(ProjectOnBox, IsContinuousWhereTheProbeFadesOut) {
    ReflectionProbe box = box_probe({0, 0, 0}, {2, 1, 3}, 0.5f);
    box.box_center = {0.3f, -0.2f, 0.5f};
    std::mt19937 random(8);
    constexpr int kSteps = 300, kHalvings = 25;
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 direction = random_unit_vector(random);
        const glm::dvec3 end = 6.0 * glm::dvec3(random_unit_vector(random));
        const auto at = [&](double way) { return project_on_box(box, way * end, direction); };
        for (int step = 0; step < kSteps; ++step) {
            // Follows the larger change into ever smaller pieces: a step would stay.
            double a = step / double{kSteps}, b = (step + 1) / double{kSteps};
            for (int j = 0; j < kHalvings; ++j) {
                const double middle = 0.5 * (a + b);
                const bool is_first =
                    glm::distance(at(a), at(middle)) > glm::distance(at(middle), at(b));
                (is_first ? b : a) = middle;
            }
            ASSERT_LT(glm::distance(at(a), at(b)), 1e-4f) << i << " " << a;
        }
        EXPECT_LT(glm::distance(at(1.0), direction), 1e-6f);
    }
}

TEST(SampleReflections, AddsTheProbesByTheirWeights) {
    const Reflections cubes =
        make_reflections(4, 1, {{}, {}, {}}, [](uint32_t probe, uint32_t, const glm::vec3&) {
            return glm::vec3(probe == 0, probe == 1, probe == 2);
        });
    ReflectionBlend blend;
    blend.probes = {2, 0, 1};
    blend.weights = {0.5f, 0.25f, 0.25f};
    const glm::vec3 light = sample_reflections(cubes.view(), blend, {0, 0, 0}, {1, 2, 3}, 0.4f);
    EXPECT_LT(glm::distance(light, glm::vec3(0.25f, 0.25f, 0.5f)), 1e-6f);
    blend.probes = {7, 8, 9};
    EXPECT_EQ(sample_reflections(cubes.view(), blend, {0, 0, 0}, {1, 2, 3}, 0.4f), glm::vec3(0.0f));
}

TEST(SampleReflections, LooksFromThePositionInTheBox) {
    // Light of the direction itself: its decoded value is the direction to the wall.
    const ReflectionProbe box = box_probe({0, 0, 0}, {2, 1, 3}, 0.0f);
    const Reflections cubes = make_reflections(
        64, 1, {box}, [](uint32_t, uint32_t, const glm::vec3& d) { return 0.5f * d + 0.5f; });
    const glm::dvec3 position(1.0, 0.5, -1.0);
    const glm::vec3 light = sample_reflections(
        cubes.view(), blend_reflections(cubes.view(), position), position, {0, -1, 0}, 0.0f);
    EXPECT_LT(glm::distance(2.0f * light - 1.0f, glm::normalize(glm::vec3(1, -1, -1))), 2e-3f);
}

TEST(ReflectionIrradiance, AddsTheProbesByTheirWeights) {
    Reflections cubes = make_random_reflections(4, 1, {{}, {}});
    cubes.probes[0].irradiance = irradiance_from_radiance(constant_radiance({1, 2, 3}));
    cubes.probes[1].irradiance = irradiance_from_radiance(constant_radiance({5, 6, 7}));
    ReflectionBlend blend;
    blend.probes = {0, 1, 99};
    blend.weights = {0.75f, 0.25f, 1.0f};
    const glm::vec3 irradiance = reflection_irradiance(cubes.view(), blend, {0, 1, 0});
    EXPECT_LT(glm::distance(irradiance, 3.14159265f * glm::vec3(2, 3, 4)), 1e-4f);
}

TEST(ReflectionOcclusion, OfRoughSurfacesIsTheRatioOfLuminances) {
    for (const float roughness : {0.5f, 1.0f}) {
        EXPECT_EQ(reflection_occlusion({1, 1, 1}, {4, 4, 4}, roughness), 0.25f);
        EXPECT_NEAR(reflection_occlusion({0, 1, 0}, {1, 1, 1}, roughness), 0.7152f,
                    1e-6f);  // Rec.709
        EXPECT_EQ(reflection_occlusion({3, 3, 3}, {1, 1, 1}, roughness), 1.0f);
        EXPECT_EQ(reflection_occlusion({-1, -1, -1}, {1, 1, 1}, roughness), 0.0f);
        EXPECT_EQ(reflection_occlusion({0, 0, 0}, {0, 0, 0}, roughness), 1.0f);  // a black cube
    }
}

TEST(ReflectionOcclusion, MirrorsHaveNone) {
    for (const float roughness : {0.0f, 0.1f})
        EXPECT_EQ(reflection_occlusion({1, 1, 1}, {4, 4, 4}, roughness), 1.0f);
    EXPECT_NEAR(reflection_occlusion({1, 1, 1}, {4, 4, 4}, 0.3f), 0.625f, 1e-6f);  // halfway
}

}  // namespace
}  // namespace tetralight
