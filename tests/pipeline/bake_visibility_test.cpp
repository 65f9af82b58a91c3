// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_visibility.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/receiver.h>
#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"
#include "tests/support/rooms.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

struct Found {
    ProbeVolume volume;
    VisibilityReport report;
};

/// The visibility between probes that sample their light where they stand, plus `offset`.
Found find(const Scene& scene, const std::vector<glm::dvec3>& positions,
           const glm::dvec3& offset = glm::dvec3(0.0), uint32_t thread_count = 0) {
    Found found{test::make_lit_volume(positions), {}};
    std::vector<glm::dvec3> capture = found.volume.exact_positions;
    for (glm::dvec3& position : capture) position += offset;
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    found.report = bake_visibility(*traced, capture, thread_count, found.volume);
    EXPECT_TRUE(verify(found.volume.view()));
    return found;
}

/// A square of 20 × 20 m across the x axis.
Scene wall(float x) {
    Scene scene;
    test::add_quad(scene, test::diffuse(glm::vec3(0.5f)), {x, -10, -10}, {0, 20, 0}, {0, 0, 20});
    return scene;
}

/// The fraction of weights that belongs to probes on the position's side of the wall at x.
double own_side(const ProbeVolume& volume, const glm::vec3& position, double x) {
    const CellLocation seen = visible_location(volume.view(), locate(volume.view(), position));
    double own = 0.0;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = volume.cells[seen.cell].vertices[i];
        if (probe == kNoIndex) continue;
        const bool is_own = (volume.exact_positions[probe].x > x) == (double{position.x} > x);
        if (is_own) own += double{seen.weights[i]};
    }
    return own;
}

TEST(BakeVisibility, HidesAllProbesBehindAPlanarWall) {
    constexpr float kX = 0.13f;
    const Found found = find(wall(kX), test::random_positions(200, 1));
    std::mt19937_64 engine(2);
    std::uniform_real_distribution<float> coordinate(-0.6f, 0.6f);
    double sum = 0.0, worst = 1.0;
    int count = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 position(coordinate(engine), coordinate(engine), coordinate(engine));
        if (std::abs(position.x - kX) < 0.03f) continue;
        const double own = own_side(found.volume, position, double{kX});
        sum += own;
        worst = std::min(worst, own);
        ++count;
    }
    EXPECT_GT(sum / count, 0.999);
    EXPECT_GT(worst, 0.5);
}

TEST(BakeVisibility, StoresNothingWhereNothingIsBlocked) {
    const Found found = find(wall(5.0f), test::random_positions(100, 3));
    EXPECT_EQ(found.report.blocked_edge_count, 0u);
    EXPECT_TRUE(found.volume.cell_visibility.empty());
    EXPECT_FALSE(found.volume.visibility_blocks.empty());
    EXPECT_EQ(found.report.unclear_cell_count, 0u);
}

/// A wall at x = 0 where a lattice has probes.
TEST(BakeVisibility, LeavesProbesOnAWallFree) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 27; ++i) positions.emplace_back(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const Found found = find(wall(0.0f), positions);
    const ProbeEdges edges(found.volume.view());
    const auto codes = edge_codes(edges, found.volume.view());
    for (uint32_t probe = 0; probe < 27; ++probe) {
        const double x = found.volume.exact_positions[probe].x;
        for (const uint32_t target : edges.targets(probe)) {
            const bool is_through = x * found.volume.exact_positions[target].x < 0.0;
            EXPECT_EQ(codes[edges.find(probe, target)] > kUnknownEdge, is_through);
        }
    }
}

/// One tetrahedron whose first corner is in the edge of a room, and the same behind one wall.
TEST(BakeVisibility, TellsTwoWallsThatMeetFromOne) {
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    const Material grey = test::diffuse(glm::vec3(0.5f));
    Scene two = wall(1.8f);
    test::add_quad(two, grey, {-10, 1.8f, -10}, {0, 0, 20}, {20, 0, 0});
    Scene one;
    test::add_quad(one, grey, {11.8f, -10, -10}, {-20, 20, 0}, {0, 0, 20});
    for (const Scene* scene : {&two, &one}) {
        const ProbeVolume volume = find(*scene, corners).volume;
        const auto place = [&](const glm::dvec3& position) {
            const auto found = std::ranges::find(volume.exact_positions, position);
            const auto probe = static_cast<uint32_t>(found - volume.exact_positions.begin());
            return static_cast<size_t>(std::ranges::find(volume.cells[0].vertices, probe) -
                                       volume.cells[0].vertices.begin());
        };
        const uint32_t element = find_visibility(volume.view(), 0);
        ASSERT_NE(element, kNoIndex);
        const uint32_t bits = split_bits(volume.cell_visibility[element]);
        const uint32_t bit = split_bit(place(corners[0]), place(corners[1]), place(corners[2]));
        EXPECT_EQ((bits & bit) != 0, scene == &two);
        // Between the walls, behind the diagonal from one blocked edge to the other.
        const glm::vec3 position(1.4f, 1.4f, 0.2f);
        const CellLocation seen = visible_location(volume.view(), locate(volume.view(), position));
        EXPECT_EQ(double{seen.weights[static_cast<int>(place(corners[0]))]} > 0.8, scene == &two);
    }
}

/// One tetrahedron, and a small box inside it that meets none of its edges.
TEST(BakeVisibility, CountsCellsWithAPillarThatMeetsNoEdge) {
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {0.8f, 0.8f, 0.8f},
                  {1.2f, 1.2f, 1.2f});
    const Found found = find(scene, corners);
    EXPECT_EQ(found.report.blocked_edge_count, 0u);
    EXPECT_EQ(found.report.unclear_cell_count, 1u);
}

TEST(BakeVisibility, SeesFromWhereProbesSampleTheirLight) {
    // A probe inside a wall of 0.4 m, whose light is sampled in front of it.
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-0.2f, -9, -9},
                  {0.2f, 9, 9});
    const std::vector<glm::dvec3> positions{{0, 0, 0}, {2, 0.1, 0}, {-2, 0.1, 0}};
    const std::vector<glm::dvec3> capture{{0.3, 0, 0}, {2, 0.1, 0}, {-2, 0.1, 0}};
    ProbeVolume volume = test::make_lit_volume(positions);
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    std::vector<glm::dvec3> sorted;
    for (const glm::dvec3& position : volume.exact_positions) {
        sorted.push_back(capture[static_cast<size_t>(std::ranges::find(positions, position) -
                                                     positions.begin())]);
    }
    EXPECT_EQ(bake_visibility(*traced, sorted, 1, volume).left_out_count, 0u);
    const ProbeEdges edges(volume.view());
    const auto codes = edge_codes(edges, volume.view());
    const auto index = [&](const glm::dvec3& position) {
        return static_cast<uint32_t>(std::ranges::find(volume.exact_positions, position) -
                                     volume.exact_positions.begin());
    };
    const uint32_t inside = index(positions[0]), right = index(positions[1]),
                   left = index(positions[2]);
    EXPECT_LT(codes[edges.find(inside, right)], kUnknownEdge);
    EXPECT_GT(codes[edges.find(inside, left)], kUnknownEdge);
}

TEST(BakeVisibility, LeavesOutProbesThatWereMovedThroughAWall) {
    Scene scene;  // its front faces the probes
    test::add_quad(scene, test::diffuse(glm::vec3(0.5f)), {0, -10, -10}, {0, 0, 20}, {0, 20, 0});
    const Found found =
        find(scene, {{-0.5, 0, 0}, {-1, 1, 0}, {-1, 0, 1}, {-2, 0.2, 0.1}}, {0.7, 0, 0});
    EXPECT_EQ(found.report.left_out_count, 1u);
}

TEST(BakeVisibility, KnowsWallsOfFlatSets) {
    auto positions = test::random_positions(60, 4);
    for (glm::dvec3& position : positions) position.y = 0.5;
    const Found plane = find(wall(0.1f), positions);
    EXPECT_GT(plane.report.blocked_edge_count, 0u);
    EXPECT_GT(own_side(plane.volume, {0.2f, 3.0f, 0.1f}, 0.1), 0.98);
    EXPECT_GT(own_side(plane.volume, {-0.0f, -3.0f, 0.1f}, 0.1), 0.98);
    const Found line = find(wall(0.1f), {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}});
    EXPECT_EQ(line.report.blocked_edge_count, 2u);
    EXPECT_GT(own_side(line.volume, {0.4f, 1.0f, 0.1f}, 0.1), 0.98);
    EXPECT_GT(own_side(line.volume, {0.05f, 1.0f, 0.1f}, 0.1), 0.98);
    EXPECT_EQ(find(wall(0.1f), {{0, 0, 0}}).report.edge_count, 0u);
    EXPECT_EQ(find(wall(0.1f), {}).report.edge_count, 0u);
}

TEST(BakeVisibility, IsTheSameForAnyNumberOfThreads) {
    Scene scene = wall(0.1f);
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-0.7f, -0.3f, 0},
                  {-0.2f, 0.4f, 0.5f});
    const auto positions = test::random_positions(300, 5);
    const Found one = find(scene, positions, glm::dvec3(0.0), 1);
    const Found two = find(scene, positions, glm::dvec3(0.0), 2);
    EXPECT_EQ(one.volume, two.volume);
    EXPECT_EQ(one.report.unclear_cell_count, two.report.unclear_cell_count);
    EXPECT_EQ(one.report.ray_count, two.report.ray_count);
}

/// Light of the dark room as a share of that of the lit one, at random positions at least 5 cm from
/// the walls.
double leak(const ProbeVolumeView& volume, float thickness, Walls walls) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<float> x(0.05f, 3.95f), y(0.05f, 2.95f);
    float lit = 0.0f, dark = 0.0f;
    for (int i = 0; i < 2500; ++i) {
        const glm::vec3 position(x(engine) + 0.5f * thickness, y(engine), x(engine));
        for (const float side : {-1.0f, 1.0f}) {
            const auto location = locate(volume, position * glm::vec3(side, 1, 1));
            const float light = interpolate(volume, location, {walls}).irradiance.coefficients[0].x;
            (side < 0.0f ? lit : dark) += light;
        }
    }
    return static_cast<double>(dark / lit);
}

TEST(BakeVisibility, KeepsTheLightOfARoomOutOfTheNext) {
    for (const float thickness : {0.2f, 0.05f, 0.0f}) {
        for (const double spacing : {1.0, 2.0}) {
            BakeVolumeSettings settings;
            settings.bake.sample_count = 64;
            const auto baked = bake_volume(
                test::two_rooms(thickness),
                {{test::make_group("rooms", test::in_rooms(double{thickness}, spacing))}},
                settings);
            ASSERT_TRUE(baked);
            const ProbeVolumeView volume = baked->volume.view();
            EXPECT_GT(leak(volume, thickness, Walls::Ignore), 0.005) << thickness << " " << spacing;
            EXPECT_LT(leak(volume, thickness, Walls::HideProbes), 0.001)
                << thickness << " " << spacing;
        }
    }
}

}  // namespace
}  // namespace tetralight
