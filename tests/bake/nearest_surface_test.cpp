// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/detail/closest_point.h>
#include <tetralight/bake/rays/ray_caster.h>
#include "tests/support/random_probes.h"
#include "tests/support/solids.h"

namespace tetralight {
namespace {

using detail::closest_point;

constexpr std::array<glm::vec3, 3> kTriangle = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

TEST(ClosestPoint, LiesInTheTriangleOnItsEdgesOrAtItsCorners) {
    EXPECT_EQ(closest_point({1, 1, 5}, kTriangle), glm::vec3(1, 1, 0));
    EXPECT_EQ(closest_point({2, -3, 1}, kTriangle), glm::vec3(2, 0, 0));
    EXPECT_EQ(closest_point({-1, 3, -2}, kTriangle), glm::vec3(0, 3, 0));
    EXPECT_EQ(closest_point({4, 4, 2}, kTriangle), glm::vec3(2, 2, 0));
    EXPECT_EQ(closest_point({9, -1, 0}, kTriangle), glm::vec3(4, 0, 0));
}

TEST(ClosestPoint, OfATriangleWithoutAreaIsOnItsEdges) {
    EXPECT_EQ(closest_point({1, 1, 0}, {{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}}), glm::vec3(1, 0, 0));
    EXPECT_EQ(closest_point({1, 1, 0}, {{{3, 0, 0}, {3, 0, 0}, {3, 0, 0}}}), glm::vec3(3, 0, 0));
}

TEST(RayCaster, FindsTheNearestPointOfAllTriangles) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<float> value(-1.0f, 1.0f);
    const auto random = [&] { return glm::vec3(value(engine), value(engine), value(engine)); };
    std::vector<std::array<glm::vec3, 3>> triangles;
    RayCaster caster;
    caster.add_spheres(std::array{glm::vec4(0, 0, 0, 0.5f)});  // does not count
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 corner = random();
        triangles.push_back({corner, corner + 0.2f * random(), corner + 0.2f * random()});
        caster.add_triangles(triangles.back(), std::array{0u, 1u, 2u});
    }
    ASSERT_TRUE(caster.commit());
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 position = 2.0f * random();
        float least = 1e9f;
        for (const auto& triangle : triangles) {
            least = std::min(least, glm::distance(position, closest_point(position, triangle)));
        }
        const auto nearest = caster.nearest_point(position);
        ASSERT_TRUE(nearest);
        EXPECT_EQ(glm::distance(position, *nearest), least);
    }
}

TEST(RayCaster, WithoutTrianglesThereIsNoNearestPoint) {
    RayCaster caster;
    caster.add_spheres(std::array{glm::vec4(0, 0, 0, 0.5f)});
    ASSERT_TRUE(caster.commit());
    EXPECT_FALSE(caster.nearest_point({0, 0, 0}));
}

/// Evaluates the probe visibility of random positions in [-2, 2]³ and returns the fraction whose
/// `is_inside` agrees.
template <class Inside>
double agreement(const Scene& scene, Inside is_inside) {
    const auto positions = test::random_positions(4000, 5, 2.0);
    const auto visibility = probe_visibilities(scene, positions);
    EXPECT_TRUE(visibility);
    size_t agreeing = 0, inside = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        agreeing += (*visibility)[i].is_inside() == is_inside(positions[i]);
        inside += is_inside(positions[i]);
    }
    EXPECT_GT(inside, positions.size() / 20);
    return static_cast<double>(agreeing) / static_cast<double>(positions.size());
}

TEST(ProbeVisibility, FindsTheInsideOfClosedMeshes) {
    Scene box, ball, ring;
    const Material material = test::diffuse(glm::vec3(0.5f));
    test::add_box(box, material, test::Facing::Outward, {-1, -1.5f, -1}, {0.5f, 1, 1.8f});
    test::add_mesh(ball, material, test::sphere_mesh(1.5));
    test::add_mesh(ring, material, test::torus_mesh(1.2, 0.6));
    EXPECT_GE(agreement(box,
                        [](const glm::dvec3& p) {
                            return p.x > -1 && p.x < 0.5 && p.y > -1.5 && p.y < 1 && p.z > -1 &&
                                   p.z < 1.8;
                        }),
              0.9995);
    EXPECT_GE(agreement(ball, [](const glm::dvec3& p) { return glm::length(p) < 1.5; }), 0.9975);
    EXPECT_GE(agreement(ring, [](const glm::dvec3& p) { return test::is_in_torus(p, 1.2, 0.6); }),
              0.9975);
}

TEST(ProbeVisibility, MeasuresTheDistanceToTheNearestSurface) {
    Scene ball;
    test::add_mesh(ball, test::diffuse(glm::vec3(0.5f)), test::sphere_mesh(1.5, 200));
    const auto positions = test::random_positions(300, 6, 3.0);
    const auto visibility = probe_visibilities(ball, positions);
    ASSERT_TRUE(visibility);
    for (size_t i = 0; i < positions.size(); ++i) {
        // Chords of π/200 of the circumference are 1.5 · (π/400)² / 2 · 2 inside of it.
        EXPECT_NEAR((*visibility)[i].surface_distance, std::abs(glm::length(positions[i]) - 1.5),
                    5e-4);
    }
    const glm::dvec3 origin(0.0);
    EXPECT_EQ((*probe_visibilities(Scene{}, std::span(&origin, 1)))[0].surface_distance,
              std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace tetralight
