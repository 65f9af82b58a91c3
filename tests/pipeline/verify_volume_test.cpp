// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/verify_volume.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/recombine.h>
#include "tests/support/probe_groups.h"
#include "tests/support/rooms.h"
#include "tests/support/window_room.h"

namespace tetralight {
namespace {

ProbeVolume bake(const Scene& scene, const std::vector<glm::dvec3>& positions,
                 BakeVolumeSettings settings = {}) {
    settings.bake.sample_count = 4096;
    auto baked = bake_volume(scene, {{test::make_group("all", positions)}}, settings);
    EXPECT_TRUE(baked);
    return std::move(baked->volume);
}

/// A room with a window, a lamp and a sky, and a lattice of probes.
struct LitRoom {
    Scene scene = test::window_room();
    ProbeVolume volume;

    explicit LitRoom(const BakeVolumeSettings& settings = {}) {
        scene.environment.radiance = {1.0f, 0.8f, 0.6f};
        test::add_point_light(scene, LightMode::Mixed, glm::vec3(4.0f), {1.0f, 2.0f, 0.5f});
        std::vector<glm::dvec3> positions;
        for (double x = -1.5; x <= 1.5; x += 1.0) {
            for (double y = 0.5; y <= 2.5; y += 1.0) {
                for (double z = -1.5; z <= 1.5; z += 1.0) positions.emplace_back(x, y, z);
            }
        }
        volume = bake(scene, positions, settings);
    }
};

VerifySettings quick_settings() {
    VerifySettings settings;
    settings.place_count = 40;
    settings.effort.target_error = 0.015;
    return settings;
}

VerifyReport verify(const Scene& scene, const ProbeVolume& volume,
                    const VerifySettings& settings = quick_settings()) {
    const auto report = verify_volume(scene, volume.view(), settings);
    EXPECT_TRUE(report);
    return *report;
}

bool has_failed(const VerifyReport& report, const std::string& setting) {
    return std::ranges::any_of(
        report.failures, [&](const VerifyFailure& failure) { return failure.setting == setting; });
}

TEST(VerifyVolume, ABakeAgreesWithTheReferee) {
    const LitRoom room;
    VerifySettings settings = quick_settings();
    settings.effort.target_error = 0.01;
    settings.rules.widest_bar = 0.03;  // the bake's own bars are about 2 %
    const VerifyReport report = verify(room.scene, room.volume, settings);
    EXPECT_EQ(report.probes.size(), room.volume.positions.size());
    EXPECT_EQ(report.places.size(), 40u);
    for (const VerifyChannel& channel : report.channels) {
        EXPECT_GE(channel.within_3_sigma, 0.97);
        EXPECT_LE(channel.undecided, 0.1);
    }
    EXPECT_FALSE(has_failed(report, "max_mean_z"));
    EXPECT_LT(report.directional_difference, 0.1);
}

TEST(VerifyVolume, IsTheSameForAnyNumberOfThreads) {
    const LitRoom room;
    VerifySettings settings = quick_settings();
    settings.effort.sample_count = 4096;
    settings.thread_count = 1;
    const VerifyReport report = verify(room.scene, room.volume, settings);
    settings.thread_count = 2;
    EXPECT_EQ(report, verify(room.scene, room.volume, settings));
    settings.seed = 1;
    EXPECT_NE(report.probes, verify(room.scene, room.volume, settings).probes);
}

TEST(VerifyVolume, LightThatIsATenthTooBrightFails) {
    LitRoom room;
    for (IrradianceSh& light : room.volume.irradiance) light *= 1.1f;
    room.volume.compact.clear();
    const VerifyReport report = verify(room.scene, room.volume);
    EXPECT_TRUE(has_failed(report, "min_within"));
    EXPECT_TRUE(has_failed(report, "max_mean_z"));
    EXPECT_GT(report.channels[1].mean_z, 3.0);
    EXPECT_NEAR(report.channels[1].mean_difference, 0.1, 0.02);
}

/// Without its walls, light of the lit room leaks into the dark one.
TEST(VerifyVolume, LeaksFail) {
    const Scene scene = test::row_of_rooms({1.0f, 0.0f});
    std::vector<glm::dvec3> positions;
    test::add_probes_of_room(0, 2, 0.5, positions);
    test::add_probes_of_room(1, 2, 0.5, positions);
    ProbeVolume volume = bake(scene, positions);
    VerifySettings settings = quick_settings();
    settings.place_count = 100;
    settings.limits.max_leak_share = 0.02;
    EXPECT_FALSE(has_failed(verify(scene, volume, settings), "max_leak_share"));
    volume.visibility_blocks.clear();
    volume.cell_visibility.clear();
    const VerifyReport leaking = verify(scene, volume, settings);
    EXPECT_TRUE(has_failed(leaking, "max_leak_share")) << leaking.leak_share;
    EXPECT_FALSE(has_failed(leaking, "min_within"));
}

/// Paths end where those of the bake did, and not elsewhere unless asked to.
TEST(VerifyVolume, BouncesAreThoseOfTheBake) {
    BakeVolumeSettings baked;
    baked.bake.bounces = 1;
    const LitRoom room(baked);
    VerifySettings settings = quick_settings();
    const VerifyReport same = verify(room.scene, room.volume, settings);
    EXPECT_EQ(same.bounces, 1u);
    EXPECT_EQ(same.notes.size(), 2u);
    EXPECT_NEAR(same.channels[0].mean_difference, 0.0, 0.02);
    settings.bounces = 1000;
    EXPECT_LT(verify(room.scene, room.volume, settings).channels[0].mean_difference, -0.1);
}

TEST(VerifyVolume, ChoosesProbesAllOverTheVolume) {
    const LitRoom room;
    VerifySettings settings = quick_settings();
    settings.probe_count = 8;
    const auto report = prepare_verify(room.scene, room.volume.view(), settings);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->probes.size(), 8u);
    for (size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(report->probes[i].probe / (room.volume.positions.size() / 8), i);
    }
}

TEST(VerifyVolume, LeavesOutProbesWithoutLightOfTheirOwn) {
    LitRoom room;
    room.volume.health[3].is_dilated = 1;
    const auto report = prepare_verify(room.scene, room.volume.view(), quick_settings());
    ASSERT_TRUE(report);
    EXPECT_EQ(report->excluded.dilated, 1u);
    EXPECT_EQ(report->probes.size() + 1, room.volume.positions.size());
}

/// Layers that are switched off count.
TEST(VerifyVolume, AVolumeWithLayersIsTakenAsItWasBaked) {
    BakeVolumeSettings settings;
    settings.lighting.layers = {"sky"};
    LitRoom room(settings);
    ASSERT_TRUE(recombine(room.volume, {{0.0f, 1.0f}}));
    EXPECT_FALSE(has_failed(verify(room.scene, room.volume), "max_mean_z"));
}

/// The callback keeps the only thread busy until the time is over.
TEST(VerifyVolume, ATimeLimitLeavesPositionsOut) {
    const LitRoom room;
    VerifySettings settings = quick_settings();
    settings.effort.sample_count = 1 << 16;
    settings.place_count = 0;
    settings.thread_count = 1;
    settings.time_limit_seconds = 1.0;
    const auto report =
        verify_volume(room.scene, room.volume.view(), settings, [](const BakeProgress& progress) {
            if (progress.probes_done > 0)
                std::this_thread::sleep_for(std::chrono::milliseconds(1100));
            return true;
        });
    ASSERT_TRUE(report);
    EXPECT_EQ(report->untraced_count + report->probes.size(), room.volume.positions.size());
    EXPECT_GT(report->untraced_count, 0u);
}

TEST(VerifyVolume, FailsIfTheTimeLimitEndsBeforeAnythingIsTraced) {
    const LitRoom room;
    VerifySettings settings = quick_settings();
    settings.time_limit_seconds = 1e-9;
    const auto report = verify_volume(room.scene, room.volume.view(), settings);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(report.error().field, "time_limit");
    EXPECT_EQ(report.error().value, "1e-09");
    EXPECT_NE(error_text(report.error()).find("nothing was traced"), std::string::npos);
}

TEST(VerifyVolume, RefusesToCompareNothing) {
    VerifySettings settings;
    settings.probe_count = settings.place_count = 0;
    const auto report = verify_volume(Scene{}, ProbeVolumeView{}, settings);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(report.error().field, "probes");
}

/// Halves round each coefficient by 2^-11 of it at most, or by 2^-37 of the largest one.
TEST(VerifyVolume, LightInHalvesIsLight) {
    LitRoom room;
    const auto floats = prepare_verify(room.scene, room.volume.view(), quick_settings());
    room.volume.irradiance.clear();
    const auto halves = prepare_verify(room.scene, room.volume.view(), quick_settings());
    ASSERT_TRUE(floats);
    ASSERT_TRUE(halves);
    ASSERT_EQ(floats->probes.size(), halves->probes.size());
    for (size_t i = 0; i < floats->probes.size(); ++i) {
        const double expected = floats->probes[i].volume.y;
        EXPECT_NEAR(halves->probes[i].volume.y, expected, 0x1p-11 * expected);
    }
    EXPECT_GT(halves->probes[0].volume.y, 0.0);
}

TEST(VerifyVolume, RefusesVolumesWithoutLight) {
    LitRoom room;
    room.volume.irradiance.clear();
    room.volume.compact.clear();
    const auto report = verify_volume(room.scene, room.volume.view(), {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().field, "volume");
}

TEST(VerifyVolume, CanBeCancelled) {
    const LitRoom room;
    const auto report = verify_volume(room.scene, room.volume.view(), quick_settings(),
                                      [](const BakeProgress&) { return false; });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace tetralight
