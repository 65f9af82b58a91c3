// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace tetralight {
namespace {

constexpr std::array<glm::vec3, 3> kTriangle = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
constexpr std::array<uint32_t, 3> kIndices = {0, 1, 2};

/// The triangle in the plane z = 0 that faces +Z, and it again at z = 5.
RayCaster two_triangles() {
    RayCaster caster;
    std::vector<glm::vec3> farther(kTriangle.begin(), kTriangle.end());
    for (glm::vec3& p : farther) p.z += 5.0f;
    caster.add_triangles(kTriangle, kIndices);
    caster.add_triangles(farther, kIndices);
    EXPECT_TRUE(caster.commit());
    return caster;
}

TEST(RayCaster, NumbersGeometriesFromZero) {
    RayCaster caster;
    EXPECT_EQ(caster.add_triangles(kTriangle, kIndices), 0u);
    EXPECT_EQ(caster.add_spheres(std::array{glm::vec4(1.0f)}), 1u);
    EXPECT_EQ(caster.add_triangles(kTriangle, kIndices), 2u);
}

TEST(RayCaster, FindsTheNearestTriangleAndWhereInIt) {
    const RayCaster caster = two_triangles();
    const auto hit = caster.intersect({{1, 2, 10}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->geometry, 1u);
    EXPECT_EQ(hit->primitive, 0u);
    EXPECT_FLOAT_EQ(hit->distance, 5.0f);
    EXPECT_NEAR(hit->barycentric.x, 0.25f, 1e-6f);  // (1, 2) = 1/4 (4, 0) + 2/4 (0, 4)
    EXPECT_NEAR(hit->barycentric.y, 0.5f, 1e-6f);
}

TEST(RayCaster, NormalIsOnTheCounterClockwiseSideFromBothSides) {
    const RayCaster caster = two_triangles();
    EXPECT_EQ(glm::normalize(caster.intersect({{1, 1, 9}, {0, 0, -1}})->normal),
              glm::vec3(0, 0, 1));
    EXPECT_EQ(glm::normalize(caster.intersect({{1, 1, -9}, {0, 0, 1}})->normal),
              glm::vec3(0, 0, 1));
}

TEST(RayCaster, DistanceIsInUnitsOfTheDirection) {
    EXPECT_FLOAT_EQ(two_triangles().intersect({{1, 1, 9}, {0, 0, -2}})->distance, 2.0f);
}

TEST(RayCaster, MissesBesideAndBehind) {
    const RayCaster caster = two_triangles();
    EXPECT_FALSE(caster.intersect({{3, 3, 9}, {0, 0, -1}}));
    EXPECT_FALSE(caster.intersect({{1, 1, 9}, {0, 0, 1}}));
}

TEST(RayCaster, MaxDistanceEndsTheRay) {
    const RayCaster caster = two_triangles();
    EXPECT_TRUE(caster.occluded({{1, 1, 9}, {0, 0, -1}, 4.1f}));
    EXPECT_FALSE(caster.occluded({{1, 1, 9}, {0, 0, -1}, 3.9f}));
    EXPECT_FALSE(caster.intersect({{1, 1, 9}, {0, 0, -1}, 3.9f}));
}

TEST(RayCaster, SharedEdgesDoNotLeak) {
    // A fan of triangles around the origin: rays at its edges and its center all hit.
    RayCaster caster;
    std::vector<glm::vec3> positions = {{0, 0, 0}};
    std::vector<uint32_t> indices;
    constexpr uint32_t kCount = 17;
    for (uint32_t i = 0; i < kCount; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / kCount;
        positions.emplace_back(std::cos(angle), std::sin(angle), 0.1f * static_cast<float>(i % 3));
        indices.insert(indices.end(), {0, 1 + i, 1 + (i + 1) % kCount});
    }
    caster.add_triangles(positions, indices);
    ASSERT_TRUE(caster.commit());
    for (uint32_t i = 0; i < 1000; ++i) {
        const glm::vec3 on_edge = positions[1 + i % kCount] * (static_cast<float>(i) / 1001.0f);
        EXPECT_TRUE(caster.occluded({on_edge + glm::vec3(0, 0, 7), {0, 0, -1}})) << i;
    }
}

TEST(RayCaster, HitsSpheresFromOutside) {
    RayCaster caster;
    caster.add_spheres(std::array{glm::vec4(0, 0, 0, 1), glm::vec4(10, 0, 0, 2)});
    ASSERT_TRUE(caster.commit());
    const auto hit = caster.intersect({{10, 0, 7}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->primitive, 1u);
    EXPECT_NEAR(hit->distance, 5.0f, 1e-5f);
    EXPECT_NEAR(glm::normalize(hit->normal).z, 1.0f, 1e-6f);
}

TEST(RayCaster, SphereNormalsPointAwayFromItsCenter) {
    RayCaster caster;
    caster.add_spheres(std::array{glm::vec4(1, 2, 3, 2)});
    ASSERT_TRUE(caster.commit());
    // At height 1.2 of radius 2 the surface stands at 1.6 = √(4 − 1.44).
    const auto hit = caster.intersect({{1, 3.2f, 13}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 10.0f - 1.6f, 1e-5f);
    EXPECT_LT(glm::distance(glm::normalize(hit->normal), glm::vec3(0, 0.6f, 0.8f)), 1e-5f);
}

/// Lets rays pass where the triangle's second weight is below a half.
bool stops_at_second_corner(const void* context, const Ray&, const RayHit& hit) {
    return hit.barycentric.x >= *static_cast<const float*>(context);
}

TEST(RayCaster, FilterAppliesToIntersectAndOccluded) {
    const float limit = 0.5f;
    RayCaster caster({stops_at_second_corner, &limit});
    caster.add_triangles(kTriangle, kIndices, RayCaster::Filtered::Yes);
    ASSERT_TRUE(caster.commit());
    EXPECT_TRUE(caster.intersect({{3, 0.5f, 1}, {0, 0, -1}}));
    EXPECT_FALSE(caster.intersect({{1, 0.5f, 1}, {0, 0, -1}}));
    EXPECT_TRUE(caster.occluded({{3, 0.5f, 1}, {0, 0, -1}}));
    EXPECT_FALSE(caster.occluded({{1, 0.5f, 1}, {0, 0, -1}}));
}

TEST(RayCaster, UnfilteredGeometryStopsAllRays) {
    const float limit = 0.5f;
    RayCaster caster({stops_at_second_corner, &limit});
    caster.add_triangles(kTriangle, kIndices);
    ASSERT_TRUE(caster.commit());
    EXPECT_TRUE(caster.intersect({{1, 0.5f, 1}, {0, 0, -1}}));
}

TEST(RayCaster, FilteredRayContinuesToTheNextSurface) {
    const float limit = 2.0f;  // no weight reaches it: all pass
    RayCaster caster({stops_at_second_corner, &limit});
    std::vector<glm::vec3> behind(kTriangle.begin(), kTriangle.end());
    for (glm::vec3& p : behind) p.z -= 1.0f;
    caster.add_triangles(kTriangle, kIndices, RayCaster::Filtered::Yes);
    caster.add_triangles(behind, kIndices);
    ASSERT_TRUE(caster.commit());
    EXPECT_EQ(caster.intersect({{1, 1, 1}, {0, 0, -1}})->geometry, 1u);
}

TEST(RayCaster, StaysValidWhenMoved) {
    const float limit = 0.5f;
    RayCaster source({stops_at_second_corner, &limit});
    source.add_triangles(kTriangle, kIndices, RayCaster::Filtered::Yes);
    ASSERT_TRUE(source.commit());
    const RayCaster moved = std::move(source);
    EXPECT_TRUE(moved.intersect({{3, 0.5f, 1}, {0, 0, -1}}));
    EXPECT_FALSE(moved.intersect({{1, 0.5f, 1}, {0, 0, -1}}));
}

TEST(RayCaster, CallsAListenerWithEachRayAndTheDistanceOfItsHit) {
    RayCaster caster = two_triangles();
    std::vector<std::pair<RayKind, float>> heard;
    caster.listen({[](void* context, const Ray&, RayKind kind, float distance) {
                       static_cast<decltype(heard)*>(context)->emplace_back(kind, distance);
                   },
                   &heard});
    (void)caster.intersect({{1, 1, 7}, {0, 0, -1}});
    (void)caster.intersect({{1, 1, 7}, {0, 0, 1}});
    (void)caster.occluded({{1, 1, 7}, {0, 0, -1}});
    caster.listen({});
    (void)caster.occluded({{1, 1, 7}, {0, 0, -1}});
    constexpr float kNone = std::numeric_limits<float>::infinity();
    const decltype(heard) expected{
        {RayKind::Nearest, 2.0f}, {RayKind::Nearest, kNone}, {RayKind::Shadow, 0.0f}};
    EXPECT_EQ(heard, expected);
}

TEST(RayCaster, EmptySceneAndEmptyGeometryHitNothing) {
    RayCaster empty;
    ASSERT_TRUE(empty.commit());
    EXPECT_FALSE(empty.intersect({{0, 0, 1}, {0, 0, -1}}));
    RayCaster no_spheres;
    no_spheres.add_spheres({});
    const Status status = no_spheres.commit();
    ASSERT_TRUE(status) << error_text(status.error());
    EXPECT_FALSE(no_spheres.occluded({{0, 0, 1}, {0, 0, -1}}));
}

}  // namespace
}  // namespace tetralight
