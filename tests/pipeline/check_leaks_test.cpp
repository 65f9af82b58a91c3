// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/check_leaks.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/recombine.h>
#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"
#include "tests/support/rooms.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

ProbeVolume bake(const Scene& scene, const std::vector<glm::dvec3>& positions,
                 BakeVolumeSettings settings = {}) {
    settings.bake.sample_count = 256;
    auto baked = bake_volume(scene, {{test::make_group("all", positions)}}, settings);
    EXPECT_TRUE(baked);
    return std::move(baked->volume);
}

LeakReport report_on(const Scene& scene, const ProbeVolume& volume, LeakSettings settings = {}) {
    settings.sample_count = 16;
    const auto report = check_leaks(scene, volume.view(), settings);
    EXPECT_TRUE(report);
    return *report;
}

/// A room of radiance 1 and a black one, with eight probes each.
struct LitAndDark {
    Scene scene = test::row_of_rooms({1.0f, 0.0f});
    ProbeVolume volume;

    LitAndDark() {
        std::vector<glm::dvec3> positions;
        test::add_probes_of_room(0, 2, 0.5, positions);
        test::add_probes_of_room(1, 2, 0.5, positions);
        volume = bake(scene, positions);
    }

    [[nodiscard]] bool is_lit(const glm::dvec3& position) const { return position.x < 2.1; }

    /// The weights of probes in the lit room, and what plain weights take from them: the mean
    /// irradiance times the weight.
    [[nodiscard]] std::pair<double, double> lit_part(const glm::dvec3& position) const {
        const CellLocation location = locate(volume.view(), glm::vec3(position));
        std::pair<double, double> sum;
        for (int i = 0; i < 4; ++i) {
            const uint32_t probe = volume.cells[location.cell].vertices[size_t(i)];
            if (probe == kNoIndex || !is_lit(volume.exact_positions[probe])) continue;
            sum.first += double{location.weights[i]};
            sum.second += double{location.weights[i]} * 0.282095 *
                          double{volume.irradiance[probe].coefficients[0].x};
        }
        return sum;
    }
};

TEST(CheckLeaks, FindsTheShareThatPlainWeightsTakeThroughAWall) {
    const LitAndDark rooms;
    const LeakReport report = report_on(rooms.scene, rooms.volume);
    ASSERT_EQ(report.places.size(), 1000u);
    double through = 0.0, missing = 0.0;
    for (const LeakPlace& place : report.places) {
        const auto [weight, light] = rooms.lit_part(place.position);
        if (rooms.is_lit(place.position)) {
            missing += light / weight - light;
        } else {
            through += light;
        }
    }
    const double scale = 1.0 / (1000.0 * report.mean_light);
    EXPECT_GT(through * scale, 0.01);
    EXPECT_NEAR(report.plain_through_walls.mean, through * scale, 1e-5);
    EXPECT_NEAR(report.plain_missing.mean, missing * scale, 1e-5);
}

/// Radiance 1 from everywhere is irradiance π on every surface.
TEST(CheckLeaks, TracesTheLightOfEachPlace) {
    const LitAndDark rooms;
    const LeakReport report = report_on(rooms.scene, rooms.volume);
    double lit_count = 0.0, noise = 0.0;
    for (const LeakPlace& place : report.places) {
        const bool is_lit = rooms.is_lit(place.position);
        lit_count += is_lit;
        EXPECT_NEAR(place.traced, is_lit ? kPi : 0.0, 0.5);
        noise += std::abs(place.traced - (is_lit ? kPi : 0.0));
    }
    EXPECT_NEAR(report.mean_light, kPi * lit_count / 1000.0, 0.01);
    EXPECT_NEAR(report.noise, noise / (1000.0 * report.mean_light), 0.2 * report.noise);
}

TEST(CheckLeaks, FindsLessWhereWeightsKnowWalls) {
    const LitAndDark rooms;
    LitAndDark without = rooms;
    without.volume.visibility_blocks.clear();
    without.volume.cell_visibility.clear();
    const LeakReport report = report_on(rooms.scene, rooms.volume);
    EXPECT_LT(report.through_walls.mean, 0.1 * report.plain_through_walls.mean);
    const LeakReport plain = report_on(rooms.scene, without.volume);
    EXPECT_NEAR(plain.through_walls.mean, report.plain_through_walls.mean, 1e-6);
    EXPECT_NEAR(plain.missing.mean, report.plain_missing.mean, 1e-6);
}

TEST(CheckLeaks, ListsTheWorstPlacesFirst) {
    LitAndDark rooms;
    rooms.volume.visibility_blocks.clear();
    rooms.volume.cell_visibility.clear();
    const LeakReport report = report_on(rooms.scene, rooms.volume);
    const auto worst = report.worst_places();
    ASSERT_EQ(worst.size(), 8u);
    for (size_t i = 0; i < worst.size(); ++i) {
        const LeakPlace& place = report.places[worst[i]];
        EXPECT_FALSE(rooms.is_lit(place.position));
        EXPECT_NEAR(place.through_walls(), rooms.lit_part(place.position).second, 1e-3);
        if (i == 0) continue;
        EXPECT_LE(place.through_walls(), report.places[worst[i - 1]].through_walls());
    }
}

TEST(CheckLeaks, FindsExactlyNothingWithoutWalls) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f, -1.0f);
    const LeakReport report = report_on(scene, bake(scene, test::random_positions(40, 1)));
    EXPECT_EQ(report.places.size(), 1000u);
    EXPECT_EQ(report.through_walls, LeakPart{});
    EXPECT_EQ(report.missing, LeakPart{});
    EXPECT_EQ(report.plain_through_walls, LeakPart{});
    EXPECT_EQ(report.unseen_count, 0u);
    EXPECT_TRUE(report.worst_places().empty());
    EXPECT_GT(report.rest.mean, 0.0);
}

/// All light of the middle room, where traced light is 0, comes through its walls.
TEST(CheckLeaks, ComparesUnseenPlacesWithTracedLight) {
    const Scene scene = test::row_of_rooms({1.0f, 0.0f, 1.0f});
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.05, positions);
    test::add_probes_of_room(2, 2, 0.05, positions);
    const LeakReport report = report_on(scene, bake(scene, positions));
    EXPECT_GT(report.unseen_count, 200u);
    for (const LeakPlace& place : report.places) {
        if (!place.is_unseen) continue;
        EXPECT_EQ(place.traced, 0.0);
        EXPECT_NEAR(place.answer, kPi, 0.5);
        EXPECT_NEAR(place.through_walls(), place.answer, 1e-6);
        EXPECT_NEAR(place.rest(), 0.0, 1e-6);
    }
}

TEST(CheckLeaks, LeavesOutDirectLightThatIsLeftToTheRuntime) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 20.0f, -1.0f);
    test::add_sun(scene, LightMode::Mixed, glm::vec3(1.0f));
    const LeakReport report = report_on(scene, bake(scene, test::random_positions(40, 1)));
    // The floor has the radiance 0.5 / π and fills nearly half of all directions.
    EXPECT_NEAR(report.mean_light, 0.25, 0.02);
    EXPECT_LT(report.rest.mean, 0.1);
}

TEST(CheckLeaks, TracesAsManyBouncesAsTheBakeDid) {
    Scene scene;
    const Material glowing = test::diffuse(glm::vec3(0.5f), glm::vec3(1.0f));
    test::add_box(scene, glowing, test::Facing::Inward, glm::vec3(0.0f), glm::vec3(2.0f));
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.5, positions);
    BakeVolumeSettings settings;
    settings.bake.bounces = 2;
    const LeakReport report = report_on(scene, bake(scene, positions, settings));
    EXPECT_NEAR(report.mean_light, kPi * (1.0 + 0.5 + 0.25), 0.05);
    EXPECT_LT(report.rest.mean, 0.1);
}

TEST(CheckLeaks, ComparesLayersAsTheyWereBaked) {
    Scene scene = test::two_rooms(0.2f);
    BakeVolumeSettings settings;
    settings.lighting.layers = {"emission"};
    ProbeVolume volume = bake(scene, test::in_rooms(0.2, 2.0), settings);
    const LeakReport baked = report_on(scene, volume, {.place_count = 50});
    ASSERT_TRUE(recombine(volume, std::vector<float>(volume.layers.size(), 3.0f)));
    EXPECT_EQ(report_on(scene, volume, {.place_count = 50}), baked);
}

/// Interpolation reads halves where they are, so that the floats beside them change nothing.
TEST(CheckLeaks, LightInHalvesIsLight) {
    LitAndDark rooms;
    ASSERT_FALSE(rooms.volume.compact.empty());
    const LeakReport report = report_on(rooms.scene, rooms.volume, {.place_count = 50});
    rooms.volume.irradiance.clear();
    EXPECT_EQ(report_on(rooms.scene, rooms.volume, {.place_count = 50}), report);
}

TEST(CheckLeaks, IsTheSameForAnyNumberOfThreads) {
    const LitAndDark rooms;
    const auto one = report_on(rooms.scene, rooms.volume, {.seed = 5, .thread_count = 1});
    EXPECT_EQ(one, report_on(rooms.scene, rooms.volume, {.seed = 5, .thread_count = 3}));
    EXPECT_NE(one, report_on(rooms.scene, rooms.volume, {.seed = 6}));
}

TEST(CheckLeaks, RefusesWhatCannotBeCompared) {
    const LitAndDark rooms;
    const auto field_of = [&](const ProbeVolume& volume, const LeakSettings& settings) {
        const auto report = check_leaks(rooms.scene, volume.view(), settings);
        EXPECT_FALSE(report);
        return report ? "" : report.error().field;
    };
    EXPECT_EQ(field_of(rooms.volume, {.place_count = 0}), "places");
    EXPECT_EQ(field_of(rooms.volume, {.sample_count = 1}), "samples");
    EXPECT_EQ(field_of(rooms.volume, {.clearance = -1.0f}), "clearance");
    EXPECT_EQ(field_of(rooms.volume, {.clearance = 5.0f}), "places");
    EXPECT_EQ(field_of(test::make_lit_volume({}), {}), "volume");
    ProbeVolume changed = rooms.volume;
    changed.metadata = R"({"relit":"--sky 2"})";
    EXPECT_EQ(field_of(changed, {}), "volume");
    changed.metadata = R"({"bounces":true})";
    EXPECT_EQ(field_of(changed, {}), "bounces");
    changed.irradiance.clear();
    changed.compact.clear();
    EXPECT_EQ(field_of(changed, {}), "volume");
}

TEST(CheckLeaks, RefusesADarkScene) {
    const LitAndDark rooms;
    const auto report =
        check_leaks(test::row_of_rooms({0.0f, 0.0f}), rooms.volume.view(), {.place_count = 10});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().field, "scene");
}

}  // namespace
}  // namespace tetralight
