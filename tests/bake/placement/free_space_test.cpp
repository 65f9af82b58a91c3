// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/free_space.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/bake/placement/grid_support.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;

PlacedProbe place(const Scene& scene, const glm::dvec3& candidate, const ClearanceRule& rule) {
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    return place_probe(*traced, candidate, rule);
}

Scene solid(const Material& material) {
    Scene scene;
    add_box(scene, material, Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    return scene;
}

TEST(FreeSpace, KeepsWhatHasRoom) {
    const PlacedProbe probe = place(solid(test::grey()), {1.5, 0, 0}, {0.2, 0.4});
    EXPECT_EQ(probe, (PlacedProbe{{1.5, 0, 0}, Fate::Kept, 0.5f}));
}

TEST(FreeSpace, PushesWhatIsTooCloseToTheClearance) {
    const PlacedProbe probe = place(solid(test::grey()), {1.05, 0.2, 0}, {0.2, 0.4});
    EXPECT_EQ(probe.fate, Fate::Pushed);
    EXPECT_NEAR(probe.position.x, 1.2, 1e-3);
    EXPECT_NEAR(probe.surface_distance, 0.2, 1e-3);
}

TEST(FreeSpace, APushAlongAnAxisLeavesTheOthersToTheBit) {
    const PlacedProbe probe = place(solid(test::grey()), {1.05, 0.2, 0.1}, {0.2, 0.4});
    EXPECT_EQ(probe.position.y, 0.2);
    EXPECT_EQ(probe.position.z, 0.1);
}

TEST(FreeSpace, PushesWhatIsInsideOutThroughTheNearestFace) {
    const PlacedProbe probe = place(solid(test::grey()), {0, 0.9, 0.3}, {0.1, 0.4});
    EXPECT_EQ(probe.fate, Fate::Pushed);
    EXPECT_NEAR(glm::distance(probe.position, glm::dvec3(0, 1.1, 0.3)), 0.0, 1e-3);
}

TEST(FreeSpace, DropsWhatWouldHaveToMoveTooFar) {
    EXPECT_EQ(place(solid(test::grey()), {0, 0, 0}, {0.1, 0.4}).fate, Fate::Inside);
    EXPECT_EQ(place(solid(test::two_sided()), {0, 0, 0}, {0.1, 0.4}).fate, Fate::Inside);
}

TEST(FreeSpace, OnAFloorItStandsUp) {
    Scene scene;
    test::add_floor(scene, test::grey(), 5.0f);
    const PlacedProbe probe = place(scene, {1, 0, 1}, {0.1, 0.4});
    EXPECT_EQ(probe.fate, Fate::Pushed);
    EXPECT_NEAR(probe.position.y, 0.1, 1e-3);
}

TEST(FreeSpace, OnAWallItStepsOffAlongTheAxis) {
    // Exactly on a face, and on an edge, where two ways out are as long.
    const PlacedProbe face = place(solid(test::grey()), {1, 0.2, 0.1}, {0.1, 0.4});
    EXPECT_EQ(face.fate, Fate::Pushed);
    EXPECT_NEAR(face.position.x, 1.1, 1e-3);
    EXPECT_EQ(glm::dvec2(face.position.y, face.position.z), glm::dvec2(0.2, 0.1));
    const PlacedProbe edge = place(solid(test::grey()), {1, 1, 0.1}, {0.1, 0.4});
    EXPECT_EQ(edge.fate, Fate::Pushed);
    EXPECT_NEAR(edge.position.y, 1.1, 1e-3);
    EXPECT_EQ(glm::dvec2(edge.position.x, edge.position.z), glm::dvec2(1, 0.1));
}

TEST(FreeSpace, InTheCornerOfARoomItStepsOffBothWalls) {
    Scene room;
    add_box(room, test::grey(), Facing::Inward, {-1, -1, -1}, {1, 1, 1});
    add_box(room, test::grey(), Facing::Outward, {-1.2f, -1.2f, -1.2f}, {1.2f, 1.2f, 1.2f});
    const PlacedProbe probe = place(room, {-1, 0.3, -1}, {0.1, 0.4});
    EXPECT_EQ(probe.fate, Fate::Pushed);
    EXPECT_NEAR(glm::distance(probe.position, glm::dvec3(-0.9, 0.3, -0.9)), 0.0, 1e-3);
    EXPECT_EQ(probe.position.y, 0.3);
}

TEST(FreeSpace, APushLeavesThePlanesOfTheLatticeOnlyWhereItMust) {
    // Outside of an edge: the nearest way off it is the diagonal, but an axis will do.
    const PlacedProbe probe = place(solid(test::grey()), {1.05, 1.05, 0.3}, {0.2, 0.4});
    EXPECT_EQ(probe.fate, Fate::Pushed);
    EXPECT_NEAR(probe.position.y, 1.0 + std::sqrt(0.2 * 0.2 - 0.05 * 0.05), 1e-3);
    EXPECT_EQ(glm::dvec2(probe.position.x, probe.position.z), glm::dvec2(1.05, 0.3));
}

TEST(FreeSpace, NothingIsPushedOutOfTheBounds) {
    const WorldBox bounds{{-2, -2, -2}, {1.15, 2, 2}};
    EXPECT_EQ(place(solid(test::grey()), {1.05, 0, 0}, {0.2, 0.4, bounds}).fate, Fate::TooClose);
    EXPECT_EQ(place(solid(test::grey()), {0.95, 0, 0}, {0.2, 0.4, bounds}).fate, Fate::Inside);
    EXPECT_EQ(place(solid(test::grey()), {1.05, 0, 0}, {0.1, 0.4, bounds}).fate, Fate::Pushed);
}

TEST(FreeSpace, ASlabThinnerThanTheClearanceKeepsBothSidesApart) {
    // 2 cm thick; the clearance is 10 cm.
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-5, -5, -0.01f}, {5, 5, 0.01f});
    const PlacedProbe front = place(scene, {0, 0, 0.03}, {0.1, 0.4});
    const PlacedProbe back = place(scene, {0, 0, -0.03}, {0.1, 0.4});
    EXPECT_NEAR(front.position.z, 0.11, 1e-3);
    EXPECT_NEAR(back.position.z, -0.11, 1e-3);
    EXPECT_EQ(place(scene, {0, 0, 0}, {0.1, 0.4}).fate, Fate::Pushed);
}

TEST(FreeSpace, AGapNarrowerThanTheClearanceHoldsNoProbe) {
    Scene scene;
    test::add_floor(scene, test::two_sided(), 50.0f, 0.0f);
    test::add_ceiling(scene, test::two_sided(), 50.0f, 0.1f);
    EXPECT_EQ(place(scene, {0, 0.05, 0}, {0.2, 0.4}).fate, Fate::TooClose);
}

TEST(FreeSpace, AnOpenPlaneHasTwoSidesOnlyWhenItsMaterialHas) {
    Scene one_sided, two_sided;
    test::add_floor(one_sided, test::grey(), 100.0f);
    test::add_floor(two_sided, test::two_sided(), 100.0f);
    EXPECT_EQ(place(one_sided, {0, 1, 0}, {0.1, 0.4}).fate, Fate::Kept);
    EXPECT_EQ(place(one_sided, {0, -1, 0}, {0.1, 0.4}).fate, Fate::Inside);
    EXPECT_EQ(place(two_sided, {0, -1, 0}, {0.1, 0.4}).fate, Fate::Kept);
}

TEST(FreeSpace, AmongFrontsOfOtherSolidsItIsStillInside) {
    // In a hollow of 20 cm between six boxes that are sunk into a large one: all fronts but for
    // the cracks between them.
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-9, -9, -9}, {9, 9, 9});
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 low(-0.095f), high(0.095f);
            low[axis] = side > 0.0f ? 0.1f : -0.5f;
            high[axis] = side > 0.0f ? 0.5f : -0.1f;
            add_box(scene, test::grey(), Facing::Outward, low, high);
        }
    }
    const auto traced = TraceScene::make_static(scene);
    const ProbeVisibility around = probe_visibility(*traced, glm::vec3(0.0f));
    EXPECT_FALSE(around.is_inside());
    EXPECT_GT(around.behind_fraction, 0.0f);
    EXPECT_EQ(place_probe(*traced, glm::dvec3(0.0), {}).fate, Fate::Inside);
}

TEST(FreeSpace, NothingIsPushedToWhereItMayBeInside) {
    // Walls that meet and cross under a roof: where their faces coincide, counts go wrong.
    Scene scene;
    const auto wall = [&](const glm::vec3& low, const glm::vec3& high) {
        add_box(scene, test::grey(), Facing::Outward, low, high);
    };
    constexpr float kHalf = 0.075f;
    wall({0, 0, -kHalf}, {4, 3, kHalf});
    wall({4, 0, -kHalf}, {8, 3, kHalf});
    wall({4 - kHalf, 0, 0}, {4 + kHalf, 3, 4});
    wall({-0.3f, 3, -0.3f}, {8.3f, 3.25f, 4.3f});
    const auto is_in = [&](const glm::dvec3& p) {
        return (p.x > 0 && p.x < 8 && std::abs(p.z) < kHalf && p.y > 0 && p.y < 3) ||
               (std::abs(p.x - 4) < kHalf && p.z > 0 && p.z < 4 && p.y > 0 && p.y < 3) ||
               (p.x > -0.3f && p.x < 8.3f && p.y > 3 && p.y < 3.25 && p.z > -0.3f && p.z < 4.3f);
    };
    const auto traced = TraceScene::make_static(scene);
    size_t pushed_count = 0;
    for (const glm::dvec3& p : test::random_positions(20'000, 5, 0.3)) {
        const PlacedProbe probe = place_probe(*traced, glm::dvec3(4, 2.9, 0) + p, {0.02, 0.08});
        pushed_count += probe.fate == Fate::Pushed;
        EXPECT_FALSE(is_kept(probe.fate) && is_in(probe.position))
            << p.x << ' ' << p.y << ' ' << p.z;
    }
    EXPECT_GT(pushed_count, 1000u);
}

TEST(FreeSpace, IntersectingTurnedSolidsAgainstAnExactTest) {
    // Two boxes that cross, one of them turned: inside is inside of either.
    Scene scene = solid(test::grey());
    auto& turned =
        add_box(scene, test::grey(), Facing::Outward, {-2, -0.5f, -0.5f}, {2, 0.5f, 0.5f});
    turned.world_from_mesh = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    const glm::dmat4 mesh_from_world = glm::inverse(turned.world_from_mesh);
    const auto in_box = [](const glm::dvec3& p, const glm::dvec3& half) {
        return std::abs(p.x) < half.x && std::abs(p.y) < half.y && std::abs(p.z) < half.z;
    };
    const auto traced = TraceScene::make_static(scene);
    size_t inside_count = 0;
    for (const glm::dvec3& p : test::random_positions(4000, 3, 2.5)) {
        const bool is_inside =
            in_box(p, glm::dvec3(1.0)) ||
            in_box(glm::dvec3(mesh_from_world * glm::dvec4(p, 1.0)), {2.0, 0.5, 0.5});
        inside_count += is_inside;
        EXPECT_EQ(place_probe(*traced, p, {}).fate, is_inside ? Fate::Inside : Fate::Kept);
    }
    EXPECT_GT(inside_count, 200u);
}

}  // namespace
}  // namespace tetralight
