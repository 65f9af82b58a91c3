// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/dilate_probes.h>

#include <gtest/gtest.h>

#include <tetralight/probes/build/make_probe_volume.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// A volume whose probe i has a constant light of i + 1.
ProbeVolume volume_of(const std::vector<glm::dvec3>& positions) {
    ProbeGroup group;
    group.name = "a";
    group.positions = positions;
    const auto merged = merge(std::span(&group, 1));
    EXPECT_TRUE(merged);
    ProbeVolume volume = make_probe_volume(*merged);
    volume.irradiance.resize(positions.size());
    volume.health.resize(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        volume.irradiance[i].coefficients[0] = glm::vec3(static_cast<float>(i + 1));
    }
    return volume;
}

/// The probe at a position on the X axis.
uint32_t at(const ProbeVolume& volume, double x) {
    for (uint32_t i = 0; i < volume.exact_positions.size(); ++i) {
        if (volume.exact_positions[i].x == x) return i;
    }
    ADD_FAILURE() << x;
    return 0;
}

std::vector<bool> invalid(const ProbeVolume& volume, const std::vector<double>& places) {
    std::vector<bool> flags(volume.positions.size(), false);
    for (const double x : places) flags[at(volume, x)] = true;
    return flags;
}

float light(const ProbeVolume& volume, double x) {
    return volume.irradiance[at(volume, x)].coefficients[0].r;
}

TEST(DilateProbes, WeighsNeighborsByTheSquareOfTheirNearness) {
    ProbeVolume volume = volume_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}});
    const float left = light(volume, 0), right = light(volume, 3);
    EXPECT_EQ(dilate_probes(invalid(volume, {1}), volume), 1u);
    EXPECT_FLOAT_EQ(light(volume, 1), (left / 1 + right / 4) / (1.0f + 0.25f));
    EXPECT_EQ(volume.health[at(volume, 1)].is_dilated, 1u);
    EXPECT_EQ(volume.health[at(volume, 0)].is_dilated, 0u);
}

TEST(DilateProbes, GoesOnThroughProbesThatItLit) {
    ProbeVolume volume = volume_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}});
    const float left = light(volume, 0);
    EXPECT_EQ(dilate_probes(invalid(volume, {1, 2, 3, 4}), volume), 4u);
    EXPECT_EQ(light(volume, 1), left);
    EXPECT_EQ(light(volume, 4), left);
}

TEST(DilateProbes, LeavesProbesAloneThatNoneReaches) {
    ProbeVolume volume = volume_of({{0, 0, 0}, {1, 0, 0}});
    const ProbeVolume before = volume;
    EXPECT_EQ(dilate_probes({true, true}, volume), 0u);
    EXPECT_EQ(volume, before);
    EXPECT_EQ(dilate_probes({false, false}, volume), 0u);
    EXPECT_EQ(volume, before);
}

TEST(DilateProbes, KeepsLightBetweenThatOfItsNeighbors) {
    ProbeVolume volume = volume_of(test::random_positions(200, 4));
    std::vector<bool> flags(200);
    for (size_t i = 0; i < 200; ++i) flags[i] = i % 3 == 0;
    EXPECT_EQ(dilate_probes(flags, volume), 67u);
    for (size_t i = 0; i < 200; ++i) {
        const float value = volume.irradiance[i].coefficients[0].r;
        EXPECT_EQ(volume.health[i].is_dilated, flags[i] ? 1u : 0u);
        if (!flags[i]) {
            EXPECT_EQ(value, static_cast<float>(i + 1));
        }
        EXPECT_GE(value, 1.0f);
        EXPECT_LE(value, 200.0f);
    }
}

}  // namespace
}  // namespace tetralight
