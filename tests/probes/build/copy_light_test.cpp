// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/copy_light.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/rendering_layers.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

ProbeVolume make_unlit_volume(std::vector<glm::dvec3> positions) {
    ProbeGroup group;
    group.name = "test";
    group.positions = std::move(positions);
    return make_probe_volume(*merge(std::span(&group, 1)));
}

/// A volume whose light says where it belongs.
ProbeVolume make_baked_volume(std::vector<glm::dvec3> positions) {
    ProbeVolume volume = test::make_lit_volume(std::move(positions));
    for (const glm::dvec3& p : volume.exact_positions) {
        volume.occlusion.emplace_back(glm::vec3(p) * 0.5f + 0.5f, 0.5f);
        volume.validity.push_back(static_cast<float>(p.x * 0.5 + 0.5));
    }
    volume.lights.resize(1);
    volume.light_names = "sun\n";
    volume.info.ambient.coefficients[0] = glm::vec3(2.0f);
    return volume;
}

TEST(CopyLight, MovesLightWithItsProbe) {
    const auto positions = test::random_positions(100, 1);
    const ProbeVolume from = make_baked_volume(positions);
    const std::vector<glm::dvec3> some(positions.begin() + 30, positions.end());
    ProbeVolume to = make_unlit_volume(some);
    const CopiedLight carried = copy_light(from.view(), to);
    EXPECT_EQ(carried.copied_count, 70u);
    EXPECT_TRUE(carried.unlit.empty());
    EXPECT_EQ(to, [&] {
        ProbeVolume expected = make_baked_volume(some);
        expected.info.world_origin = to.info.world_origin;
        return expected;
    }());
    EXPECT_TRUE(verify(to.view()));
}

TEST(CopyLight, MovesRenderingLayersUnlessTheNewGroupsHaveTheirOwn) {
    const auto positions = test::random_positions(20, 5);
    ProbeVolume from = make_baked_volume(positions);
    for (uint32_t i = 0; i < 20; ++i) from.rendering_layers.push_back(1u << i);
    auto more = positions;
    more.push_back({0.5, 0.5, 0.5});
    ProbeVolume to = make_unlit_volume(more);
    (void)copy_light(from.view(), to);
    ASSERT_EQ(to.rendering_layers.size(), 21u);
    for (uint32_t i = 0; i < 21; ++i) {
        const auto old = std::ranges::find(from.exact_positions, to.exact_positions[i]);
        const auto twin = static_cast<size_t>(old - from.exact_positions.begin());
        EXPECT_EQ(to.rendering_layers[i], twin < 20 ? 1u << twin : kAllRenderingLayers);
    }
    ProbeVolume own = make_unlit_volume(positions);
    own.rendering_layers.assign(20, 0b10);
    (void)copy_light(from.view(), own);
    EXPECT_EQ(own.rendering_layers, std::vector<uint32_t>(20, 0b10));
}

TEST(CopyLight, LeavesNewProbesUnlitAndNamesThem) {
    auto positions = test::random_positions(100, 2);
    const ProbeVolume from = make_baked_volume(positions);
    positions[7].x += 1e-12;  // no longer the same bits
    positions.push_back({0.5, 0.5, 0.5});
    ProbeVolume to = make_unlit_volume(positions);
    const CopiedLight carried = copy_light(from.view(), to);
    EXPECT_EQ(carried.copied_count, 99u);
    ASSERT_EQ(carried.unlit.size(), 2u);
    for (const uint32_t probe : carried.unlit) {
        const glm::dvec3& p = to.exact_positions[probe];
        EXPECT_TRUE(p == positions[7] || p == positions[100]);
        EXPECT_EQ(to.irradiance[probe], IrradianceSh());
        EXPECT_EQ(to.occlusion[probe], glm::vec4(1.0f));
        EXPECT_EQ(to.validity[probe], 0.0f);
    }
    EXPECT_TRUE(verify(to.view()));
}

TEST(CopyLight, LeavesOutWhatTheOtherVolumeDoesNotHave) {
    const auto positions = test::random_positions(20, 3);
    ProbeVolume to = make_unlit_volume(positions);
    copy_light(test::make_lit_volume(positions).view(), to);
    EXPECT_EQ(to.irradiance.size(), 20u);
    EXPECT_TRUE(to.occlusion.empty());
    EXPECT_TRUE(to.validity.empty());
}

TEST(CopyLight, FromAVolumeThatIsNotBakedCarriesNothing) {
    const auto positions = test::random_positions(20, 4);
    ProbeVolume to = make_unlit_volume(positions);
    const CopiedLight carried = copy_light(make_unlit_volume(positions).view(), to);
    EXPECT_EQ(carried.copied_count, 0u);
    EXPECT_EQ(carried.unlit.size(), 20u);
    EXPECT_TRUE(to.irradiance.empty());
}

TEST(CopyLight, BetweenEmptyVolumesCarriesNothing) {
    ProbeVolume to = make_unlit_volume({});
    const CopiedLight carried = copy_light(ProbeVolume().view(), to);
    EXPECT_EQ(carried.copied_count, 0u);
    EXPECT_TRUE(carried.unlit.empty());
}

}  // namespace
}  // namespace tetralight
