// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/dering_probes.h>

#include <gtest/gtest.h>

#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/sh_minimum.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A sun that shines into the probes and nothing else: the light that rings most.
Scene sunlit() {
    Scene scene;
    test::add_sun(scene, LightMode::Baked, {3, 2, 1});
    return scene;
}

ProbeGroup group(const char* name, std::vector<glm::dvec3> positions, bool asks) {
    ProbeGroup result;
    result.name = name;
    result.positions = std::move(positions);
    result.dering = asks;
    return result;
}

BakedVolume bake(const std::vector<ProbeGroup>& groups, const DeringSettings& dering = {}) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 64;
    settings.dering = dering;
    auto baked = bake_volume(sunlit(), groups, settings);
    EXPECT_TRUE(baked);
    return std::move(*baked);
}

/// The least red irradiance of the probe that a source stands for.
double least(const ProbeVolume& volume, size_t source) {
    return minimum_irradiance(volume.irradiance[volume.sources[source].probe]).r;
}

TEST(DeringProbes, TreatsTheGroupsThatAsk) {
    const auto baked =
        bake({group("a", {{0, 0, 0}, {1, 0, 0}}, false), group("b", {{0, 1, 0}, {0, 0, 1}}, true)});
    // 4 % of the peak of 3 · 17/16 below zero, as derived for ShMinimum.
    EXPECT_NEAR(least(baked.volume, 0), 3 * -0.0395833, 1e-5);
    EXPECT_NEAR(least(baked.volume, 1), 3 * -0.0395833, 1e-5);
    EXPECT_GE(least(baked.volume, 2), 0.0);
    EXPECT_GE(least(baked.volume, 3), 0.0);
    EXPECT_NE(baked.volume.metadata.find("\"dering\":\"mildest\""), std::string::npos);
    EXPECT_TRUE(baked.report.warnings.empty());
}

TEST(DeringProbes, TreatsAWeldedProbeOfWhichOneGroupAsks) {
    const auto volume =
        bake({group("a", {{0, 0, 0}, {1, 0, 0}}, false), group("b", {{0, 0, 0}, {0, 0, 1}}, true)})
            .volume;
    EXPECT_EQ(volume.sources[0].probe, volume.sources[2].probe);
    EXPECT_GE(least(volume, 0), 0.0);
    EXPECT_LT(least(volume, 1), 0.0);
}

TEST(DeringProbes, TreatsAllWhenToldTo) {
    DeringSettings all;
    all.is_for_all_groups = true;
    const auto volume = bake({group("a", {{0, 0, 0}, {1, 0, 0}}, false)}, all).volume;
    EXPECT_GE(least(volume, 0), 0.0);
    EXPECT_GE(least(volume, 1), 0.0);
}

TEST(DeringProbes, LeavesTheLightAloneWhenNobodyAsks) {
    const auto volume = bake({group("a", {{0, 0, 0}}, false)}).volume;
    EXPECT_LT(least(volume, 0), 0.0);
    EXPECT_EQ(volume.metadata.find("dering"), std::string::npos);
}

TEST(DeringProbes, UsesTheWindowThatIsNamed) {
    DeringSettings hann;
    hann.window = DeringWindow::Hann;
    const IrradianceSh plain = bake({group("a", {{0, 0, 0}}, false)}).volume.irradiance[0];
    const auto volume = bake({group("a", {{0, 0, 0}}, true)}, hann).volume;
    EXPECT_EQ(volume.irradiance[0].coefficients[1], 0.75f * plain.coefficients[1]);
    EXPECT_NE(volume.metadata.find("\"dering\":\"hann\""), std::string::npos);
}

TEST(DeringProbes, CompactProbesHoldWhatIsLeft) {
    const auto volume = bake({group("a", {{0, 0, 0}}, true)}).volume;
    const IrradianceSh compact = compact_irradiance(volume.compact[0], volume.info.compact_scale);
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const float expected = volume.irradiance[0].coefficients[i].r;
        EXPECT_NEAR(compact.coefficients[i].r, expected, 0x1p-11f * std::abs(expected) + 1e-7f);
    }
}

}  // namespace
}  // namespace tetralight
