// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/prepare_probes.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/probe_groups.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

using test::make_group;

/// The solid box [-1, 1]³ under a white sky.
Scene solid() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    return scene;
}

const glm::dvec3 kDeep(0, 0.1, 0), kShallow(0.2, 0.9, 0.1), kOutside(3, 0, 0), kAbove(0.1, 3, 0);
const glm::dvec3 kBefore(0, -0.5, 4), kBehind(1, 0, -4);

std::vector<ProbeGroup> groups() {
    return {make_group("a", {kDeep, kShallow, kOutside, kAbove}),
            make_group("b", {kBefore, kBehind})};
}

BakedVolume bake(const HealthSettings& health, const std::vector<ProbeGroup>& given = groups()) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 64;
    settings.health = health;
    auto baked = bake_volume(solid(), given, settings);
    EXPECT_TRUE(baked);
    return std::move(*baked);
}

HealthSettings with(InvalidProbes policy) {
    HealthSettings settings;
    settings.invalid = policy;
    return settings;
}

uint32_t probe_of(const ProbeVolume& volume, uint32_t group, uint32_t index) {
    for (const ProbeSource& source : volume.sources) {
        if (source.group == group && source.index == index) return source.probe;
    }
    ADD_FAILURE() << group << ", " << index;
    return kNoIndex;
}

TEST(PrepareProbes, LeavesOutWhatHasNoWayOutAndSaysSo) {
    const BakedVolume baked = bake({});
    const ProbeVolume& volume = baked.volume;
    EXPECT_EQ(volume.positions.size(), 5u);
    EXPECT_EQ(volume.sources.size(), 6u);
    EXPECT_EQ(probe_of(volume, 0, 0), kNoIndex);
    EXPECT_EQ(volume.exact_positions[probe_of(volume, 0, 3)], kAbove);
    EXPECT_EQ(baked.report.left_out_count, 1u);
    EXPECT_EQ(baked.report.welded_count, 0u);
    ASSERT_EQ(baked.report.warnings.size(), 1u);
    EXPECT_EQ(baked.report.warnings[0],
              "group \"a\": 1 of 4 probes lie inside geometry and were left out");
}

TEST(PrepareProbes, VolumesWithoutSomeOfTheirProbesAreSound) {
    const ProbeVolume volume = bake({}).volume;
    const Status status = verify(volume.view());
    EXPECT_TRUE(status) << error_text(status.error());
    EXPECT_TRUE(validate(volume.view()).problems().empty());
}

TEST(PrepareProbes, GathersLightOutsideForProbesThatAreJustInside) {
    const BakedVolume baked = bake({});
    const ProbeVolume& volume = baked.volume;
    const uint32_t probe = probe_of(volume, 0, 1);
    EXPECT_EQ(volume.exact_positions[probe], kShallow);  // it stays
    // Through the top, 0.1 away, and 2 % of the 0.83 to the next probe of its group beyond.
    const double spacing = glm::distance(kShallow, kDeep);
    const glm::vec3 offset = volume.health[probe].virtual_offset;
    EXPECT_LT(glm::distance(offset, {0, 0.1 + 0.02 * spacing, 0}), 1e-4);
    EXPECT_EQ(volume.validity[probe], 1.0f);
    EXPECT_GT(volume.irradiance[probe].coefficients[0].r, 1.0f);
    EXPECT_EQ(baked.report.virtual_offset_count, 1u);
}

TEST(PrepareProbes, MovesNoProbeFartherThanItsShareOfTheSpacing) {
    HealthSettings settings;
    settings.virtual_offset = 0.1;  // of 0.83: less than the way out of 0.1 and the margin
    EXPECT_EQ(bake(settings).report.left_out_count, 2u);
    settings.virtual_offset = 0.0;
    EXPECT_EQ(bake(settings).report.left_out_count, 2u);
    settings.virtual_offset = 2.0;
    EXPECT_EQ(bake(settings).report.left_out_count, 0u);
}

TEST(PrepareProbes, LetsAProbeThatIsAloneGoAsFarAsTheSceneIsLarge) {
    const BakedVolume baked = bake({}, {make_group("alone", {kDeep})});
    EXPECT_EQ(baked.report.virtual_offset_count, 1u);
    EXPECT_GT(baked.volume.health[0].virtual_offset.y, 0.9f);
}

TEST(PrepareProbes, MeasuresTheDistanceFromTheProbeToTheNearestSurface) {
    const ProbeVolume volume = bake({}).volume;
    EXPECT_NEAR(volume.health[probe_of(volume, 0, 2)].surface_distance, 2.0f, 1e-6f);
    EXPECT_NEAR(volume.health[probe_of(volume, 0, 1)].surface_distance, 0.1f, 1e-6f);
}

TEST(PrepareProbes, KeepsInvalidProbesWhenToldTo) {
    const BakedVolume baked = bake(with(InvalidProbes::Keep));
    const uint32_t deep = probe_of(baked.volume, 0, 0);
    EXPECT_EQ(baked.volume.positions.size(), 6u);
    EXPECT_EQ(baked.volume.validity[deep], 0.0f);
    EXPECT_EQ(baked.volume.irradiance[deep], IrradianceSh{});
    ASSERT_EQ(baked.report.warnings.size(), 2u);  // in geometry, and dark
    EXPECT_EQ(baked.report.warnings[1].find("group \"a\": 1 of 4 probes receive no light at all"),
              0u);
}

TEST(PrepareProbes, DilatesInvalidProbesWhenToldTo) {
    const BakedVolume baked = bake(with(InvalidProbes::Dilate));
    const uint32_t deep = probe_of(baked.volume, 0, 0);
    EXPECT_EQ(baked.report.dilated_count, 1u);
    EXPECT_EQ(baked.volume.health[deep].is_dilated, 1u);
    EXPECT_GT(baked.volume.irradiance[deep].coefficients[0].r, 1.0f);
    EXPECT_EQ(baked.volume.validity[deep], 0.0f);
    EXPECT_EQ(baked.report.warnings.size(), 1u);
}

TEST(PrepareProbes, AVolumeMayLoseAllItsProbes) {
    HealthSettings settings;
    settings.virtual_offset = 0.0;
    const BakedVolume baked = bake(settings, {make_group("a", {kDeep, kShallow})});
    EXPECT_TRUE(baked.volume.positions.empty());
    EXPECT_TRUE(verify(baked.volume.view()));
    EXPECT_TRUE(validate(baked.volume.view()).problems().empty());
}

TEST(PrepareProbes, AnotherGroupChangesNoOffset) {
    auto more = groups();
    more.push_back(make_group("c", {kShallow + glm::dvec3(0.1, 0, 0), kOutside * 2.0}));
    const ProbeVolume before = bake({}).volume, after = bake({}, more).volume;
    const ProbeHealth& then = before.health[probe_of(before, 0, 1)];
    EXPECT_EQ(after.health[probe_of(after, 0, 1)], then);
    EXPECT_EQ(after.irradiance[probe_of(after, 0, 1)], before.irradiance[probe_of(before, 0, 1)]);
}

TEST(PrepareProbes, IsTheSameForAnyNumberOfThreads) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 16;
    settings.bake.thread_count = 1;
    const auto one = bake_volume(solid(), groups(), settings);
    settings.bake.thread_count = 2;
    const auto two = bake_volume(solid(), groups(), settings);
    ASSERT_TRUE(one && two);
    EXPECT_EQ(one->volume, two->volume);
}

TEST(PrepareProbes, NamesGroupsThatNoLightReaches) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Inward, {-1, -1, -1},
                  {1, 1, 1});
    // From outside the hollow shows its backs, so that the free probe has to be far away.
    const std::vector<ProbeGroup> given{make_group("a", {{0, 0, 0}, {500, 0, 0}}),
                                        make_group("b", {{0, 500, 0}})};
    BakeVolumeSettings settings;
    settings.bake.sample_count = 64;
    const auto baked = bake_volume(scene, given, settings);
    ASSERT_TRUE(baked);
    ASSERT_EQ(baked->report.warnings.size(), 1u);
    EXPECT_EQ(baked->report.warnings[0].find("group \"a\": 1 of 2 probes receive no light"), 0u);
}

}  // namespace
}  // namespace tetralight
