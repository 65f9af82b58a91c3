// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/adaptive_grid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include <tetralight/bake/placement/affine_dimension.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::error_of;
using test::Facing;
using test::grid_of;
using test::positions_of;

/// A dark room beside one with a glowing ceiling, 8 × 3 × 4 m each, with a wall of 10 cm between
/// them that has a door. Light changes in the door and under the lamp.
Scene two_rooms() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {-8, 0, -2}, {8, 3, 2});
    add_box(scene, test::grey(), Facing::Outward, {-0.05f, -0.1f, -2.1f}, {0.05f, 3.1f, -0.5f});
    add_box(scene, test::grey(), Facing::Outward, {-0.05f, -0.1f, 0.5f}, {0.05f, 3.1f, 2.1f});
    add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(5.0f)), Facing::Outward, {-5, 2.8f, -1},
            {-3, 2.9f, 1});
    return scene;
}

ProbeGridSettings adaptive(uint64_t max_count, double target_error) {
    ProbeGridSettings settings;
    settings.mode = PlacementMode::Adaptive;
    settings.max_probes = max_count;
    settings.adaptive.target_error = target_error;
    settings.adaptive.bake.bounces = 1;
    return settings;
}

TEST(AdaptiveGrid, MakesTheProbesThatItMayAndGetsBetterWithMore) {
    const ProbeGrid few = grid_of(two_rooms(), adaptive(80, 1e-4));
    const ProbeGrid many = grid_of(two_rooms(), adaptive(250, 1e-4));
    EXPECT_LE(few.probe_count(), 80u);
    EXPECT_GE(few.probe_count(), 79u);
    EXPECT_LE(many.probe_count(), 250u);
    EXPECT_GE(many.probe_count(), 245u);
    EXPECT_EQ(few.adaptive->end, AdaptiveEnd::MaxProbes);
    EXPECT_EQ(many.adaptive->end, AdaptiveEnd::MaxProbes);
    EXPECT_GE(many.coverage.share(Cover::Covered), 0.98);
    EXPECT_LT(many.adaptive->error, 0.8 * few.adaptive->error);
    EXPECT_GT(many.adaptive->error, 0.0);
}

TEST(AdaptiveGrid, StopsAtTheTargetWithNoMoreProbesThanItTakes) {
    // A box on the ground under a white sky: light is dimmer around it.
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::grey(), 4.0f);
    add_box(scene, test::grey(), Facing::Outward, {-1, 0, -1}, {1, 2, 1});
    const ProbeGrid grid = grid_of(scene, adaptive(2000, 0.3));
    EXPECT_EQ(grid.adaptive->end, AdaptiveEnd::TargetReached);
    EXPECT_LE(grid.adaptive->error, 0.3);
    EXPECT_LT(grid.probe_count(), 500u);
    uint64_t all = 0;
    for (const uint64_t count : grid.fate_counts) all += count;
    EXPECT_EQ(all, grid.candidate_count);
    EXPECT_GE(grid.coverage.share(Cover::Covered), 0.97);
}

/// The share of the probes in the room with the lamp.
double lit_share(const ProbeGrid& grid) {
    const auto positions = positions_of(grid);
    const auto lit = std::ranges::count_if(positions, [](const auto& p) { return p.x < 0.0; });
    return static_cast<double>(lit) / static_cast<double>(positions.size());
}

TEST(AdaptiveGrid, PutsProbesWhereErrorsCount) {
    // Absolute errors are where the lamp is, in half of the volume; relative ones also in the dark.
    ProbeGridSettings settings = adaptive(120, 1e-4);
    settings.adaptive.error_kind = ErrorKind::Absolute;
    const double absolute = lit_share(grid_of(two_rooms(), settings));
    settings.adaptive.error_kind = ErrorKind::Relative;
    const double relative = lit_share(grid_of(two_rooms(), settings));
    EXPECT_GT(absolute, 0.6);
    EXPECT_GT(absolute, relative + 0.05);
}

TEST(AdaptiveGrid, StartsAtTheClearanceAndPutsNothingIntoWalls) {
    ProbeGridSettings settings = adaptive(150, 1e-4);
    settings.clearance = 0.1;
    const ProbeGrid grid = grid_of(two_rooms(), settings);
    for (const float distance : grid.surface_distances) EXPECT_GE(distance, 0.098f);
}

TEST(AdaptiveGrid, IsTheSameForAnyThreadsAndAnyOrder) {
    Scene scene = two_rooms();
    ProbeGridSettings settings = adaptive(80, 1e-4);
    settings.thread_count = 1;
    const ProbeGrid one = grid_of(scene, settings);
    std::swap(scene.instances[0], scene.instances[3]);
    settings.thread_count = 2;
    EXPECT_EQ(grid_of(scene, settings).groups, one.groups);
}

TEST(AdaptiveGrid, InterruptedItHasTheResultOfTheLastRound) {
    std::vector<AdaptiveProgress> seen;
    const auto grid =
        make_probe_grid(two_rooms(), adaptive(500, 1e-4), [&](const AdaptiveProgress& progress) {
            seen.push_back(progress);
            return progress.round < 3;
        });
    ASSERT_TRUE(grid) << error_text(grid.error());
    EXPECT_EQ(grid->adaptive->end, AdaptiveEnd::Interrupted);
    EXPECT_EQ(grid->adaptive->round_count, 3u);
    EXPECT_EQ(grid->probe_count(), seen.back().probe_count);
}

TEST(AdaptiveGrid, InterruptedAtOnceItHasNone) {
    const auto grid = make_probe_grid(two_rooms(), adaptive(500, 1e-4),
                                      [](const AdaptiveProgress&) { return false; });
    ASSERT_FALSE(grid);
    EXPECT_EQ(error_text(grid.error()), "interrupted");
}

TEST(AdaptiveGrid, OutOfTimeItKeepsWhatItHas) {
    ProbeGridSettings settings = adaptive(100'000, 1e-4);
    settings.adaptive.time_budget_seconds = 0.3;
    const auto grid = make_probe_grid(two_rooms(), settings);
    // On a slow machine there may be no round by then.
    if (grid) {
        EXPECT_EQ(grid->adaptive->end, AdaptiveEnd::TimeOver);
    } else {
        EXPECT_EQ(error_text(grid.error()), "out of time before there was a result");
    }
}

TEST(AdaptiveGrid, InTheDarkTheStartIsEnough) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 4, 4});
    const ProbeGrid grid = grid_of(scene, adaptive(100, 0.05));
    EXPECT_EQ(grid.adaptive->error, 0.0);
    EXPECT_LE(grid.probe_count(), 64u);
}

TEST(AdaptiveGrid, WhatIsLeftInTheDarkStillEnclosesAVolume) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 4, 4});
    EXPECT_EQ(affine_dimension(positions_of(grid_of(scene, adaptive(100, 0.05)))), 3);
}

/// Air of 16 m with a sealed and lit room of 2 m in it, between the layers of a lattice of 8 m.
Scene hidden_room() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::grey(), 8.0f, -8.0f);
    add_box(scene, test::grey(), Facing::Outward, {-1.2f, -1.2f, -1.2f}, {1.2f, 1.2f, 1.2f});
    add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(1.0f)), Facing::Inward, {-1, -1, -1},
            {1, 1, 1});
    return scene;
}

ProbeGridSettings coarse_in_the_air() {
    ProbeGridSettings settings = adaptive(60, 0.3);
    settings.bounds = WorldBox{{-8, -8, -8}, {8, 8, 8}};
    settings.spacing = glm::dvec3(8.0);
    settings.adaptive.start_spacing = settings.spacing;
    return settings;
}

std::vector<glm::dvec3> in_hidden_room(const ProbeGrid& grid) {
    std::vector<glm::dvec3> positions = positions_of(grid);
    std::erase_if(positions, [](const glm::dvec3& p) {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1.0;
    });
    return positions;
}

TEST(AdaptiveGrid, FillsSpacesThatItsLatticeMisses) {
    ProbeGridSettings settings = coarse_in_the_air();
    settings.unreachable = UnreachableSpaces::Keep;
    const ProbeGrid both = grid_of(hidden_room(), settings);
    EXPECT_EQ(affine_dimension(in_hidden_room(both)), 3);
    EXPECT_GT(positions_of(both).size(), in_hidden_room(both).size());
    settings.from = {{0.3, 0.2, 0.1}};
    settings.unreachable = UnreachableSpaces::Drop;
    const ProbeGrid room = grid_of(hidden_room(), settings);
    EXPECT_EQ(affine_dimension(in_hidden_room(room)), 3);
    EXPECT_EQ(positions_of(room).size(), in_hidden_room(room).size());
    // The light is even: no error asks for probes, but coverage does.
    EXPECT_GE(room.coverage.share(Cover::Covered), 0.97);
    EXPECT_EQ(room.groups.size(), 1u);
}

TEST(AdaptiveGrid, TellsOfSpacesThatItLeavesEmpty) {
    const ProbeGrid grid = grid_of(hidden_room(), coarse_in_the_air());
    ASSERT_EQ(grid.spaces.size(), 2u);
    EXPECT_EQ(grid.spaces[1].fate, SpaceFate::Unreachable);
    EXPECT_EQ(grid.spaces[1].probe_count, 0u);
    EXPECT_TRUE(grid.spaces[1].light.has_lights);
    const glm::dvec3 place = glm::abs(grid.spaces[1].position);
    EXPECT_LT(std::max({place.x, place.y, place.z}), 1.0);
}

TEST(AdaptiveGrid, FourProbesAreEnoughForOneSpace) {
    EXPECT_EQ(grid_of(two_rooms(), adaptive(4, 0.05)).probe_count(), 4u);
    EXPECT_EQ(error_of(two_rooms(), adaptive(3, 0.05)),
              "1 space needs 4 probes at least, more than the limit of 3");
}

TEST(AdaptiveGrid, FewerProbesThanItsSpacesNeedAreRefused) {
    // The air needs four, and each of six rooms one or more.
    Scene scene = hidden_room();
    for (const glm::vec3 center : {glm::vec3(4, 0, 0), glm::vec3(-4, 0, 0), glm::vec3(0, 4, 0),
                                   glm::vec3(0, 0, 4), glm::vec3(0, 0, -4)}) {
        add_box(scene, test::grey(), Facing::Inward, center - 1.0f, center + 1.0f);
        add_box(scene, test::grey(), Facing::Outward, center - 1.2f, center + 1.2f);
    }
    ProbeGridSettings settings = coarse_in_the_air();
    settings.unreachable = UnreachableSpaces::Keep;
    settings.dark = DarkSpaces::Keep;
    settings.max_probes = 8;
    const std::string error = error_of(scene, settings);
    EXPECT_TRUE(error.starts_with("7 spaces need 1")) << error;
    EXPECT_TRUE(error.ends_with(" probes at least, more than the limit of 8")) << error;
}

TEST(AdaptiveGrid, OverAPlaneItHasAirToFill) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::grey(), 8.0f);
    const ProbeGrid grid = grid_of(scene, adaptive(60, 0.05));
    EXPECT_GT(grid.adaptive->error, 0.0);
    EXPECT_EQ(affine_dimension(positions_of(grid)), 3);
    for (const glm::dvec3& p : positions_of(grid)) EXPECT_LE(p.y, 2.0);  // an eighth of 16 m
}

TEST(AdaptiveGrid, WithoutAPlaceToMeasureItReportsNoError) {
    const Scene scene = two_rooms();
    const auto traced = TraceScene::make_static(scene);
    const AdaptiveInput input{scene,
                              *traced,
                              {{-8, 0, -2}, {8, 3, 2}},
                              0.1,
                              0.11,
                              [](const auto&) { return false; },
                              [](const auto&) { return 0u; },
                              {},
                              100,
                              0};
    std::vector<PlacedProbe> probes;
    for (const double x : {1.0, 2.0, 3.0, 4.0}) probes.push_back({{x, 1, 0}});
    const auto report = refine_grid(input, {}, probes, {}, {});
    ASSERT_FALSE(report);
    EXPECT_EQ(error_text(report.error()),
              "the bounds have no free position off surfaces to measure light at");
}

TEST(AdaptiveGrid, SaysWithWhichSpacingItBegan) {
    ProbeGridSettings settings = coarse_in_the_air();
    EXPECT_EQ(grid_of(hidden_room(), settings).adaptive->start_spacing, glm::dvec3(8.0));
    settings.adaptive.start_spacing = settings.spacing = glm::dvec3(0.5);
    // 32 layers along each axis are far more than half of 60 probes.
    EXPECT_GT(grid_of(hidden_room(), settings).adaptive->start_spacing.x, 4.0);
}

TEST(AdaptiveGrid, RefusesASpacingThatIsNoLength) {
    ProbeGridSettings settings = adaptive(100, 0.05);
    settings.adaptive.start_spacing = glm::dvec3(0.0);
    EXPECT_EQ(error_of(two_rooms(), settings), "spacing 0 along x is not a positive length");
}

}  // namespace
}  // namespace tetralight
