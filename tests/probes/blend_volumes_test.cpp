// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/blend_volumes.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/layered_volume.h"

namespace tetralight {
namespace {

/// A scenario with one light.
ProbeVolume scenario(float brightness, glm::vec3 direction = {0, -1, 0}) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(15, 1));
    for (IrradianceSh& light : volume.irradiance) light *= brightness;
    volume.info.ambient = test::linear_light({1, 2, 3}) * brightness;
    volume.lights.resize(1);
    volume.lights[0].direction = direction;
    volume.lights[0].intensity = glm::vec3(brightness);
    volume.light_names = "sun\n";
    make_compact_probes(volume);
    return volume;
}

void give_occlusion(ProbeVolume& volume, float value) {
    volume.light_states.resize(1);
    volume.light_states[0].channel = 1;
    volume.light_states[0].mixed_lighting = MixedLighting::Shadowmask;
    volume.occlusion.assign(volume.positions.size(), glm::vec4(value));
    volume.occlusion_lights.assign(volume.positions.size(), {kNoIndex, 0, kNoIndex, kNoIndex});
}

std::string error_of(const ProbeVolume& a, const ProbeVolume& b, float t) {
    const auto blended = blend_volumes(a.view(), b.view(), t);
    EXPECT_FALSE(blended);
    return blended ? "" : error_text(blended.error());
}

TEST(BlendVolumes, BlendsLightAmbientAndOcclusion) {
    ProbeVolume a = scenario(1.0f), b = scenario(3.0f);
    give_occlusion(a, 1.0f);
    give_occlusion(b, 0.0f);
    const auto blended = blend_volumes(a.view(), b.view(), 0.25f);
    ASSERT_TRUE(blended) << error_text(blended.error());
    for (size_t i = 0; i < 15; ++i) {
        EXPECT_EQ(blended->irradiance[i], 0.75f * a.irradiance[i] + 0.25f * b.irradiance[i]);
        EXPECT_EQ(blended->occlusion[i], glm::vec4(0.75f));
    }
    EXPECT_EQ(blended->info.ambient, 0.75f * a.info.ambient + 0.25f * b.info.ambient);
    ASSERT_EQ(blended->lights.size(), 1u);
    EXPECT_EQ(blended->lights[0].intensity, glm::vec3(1.5f));
    EXPECT_EQ(count_wrong_compact_probes(blended->view()), 0u);
    EXPECT_TRUE(verify(blended->view()));
}

TEST(BlendVolumes, EndsAreTheScenarios) {
    const ProbeVolume a = scenario(1.0f), b = scenario(3.0f);
    EXPECT_EQ(blend_volumes(a.view(), b.view(), 0.0f)->irradiance, a.irradiance);
    EXPECT_EQ(blend_volumes(a.view(), b.view(), 1.0f)->irradiance, b.irradiance);
}

TEST(BlendVolumes, LightsThatMovedAreThereTwiceByTheirShares) {
    const ProbeVolume a = scenario(1.0f), b = scenario(3.0f, {1, 0, 0});
    const auto blended = blend_volumes(a.view(), b.view(), 0.5f);
    ASSERT_TRUE(blended);
    ASSERT_EQ(blended->lights.size(), 2u);
    EXPECT_EQ(blended->lights[0].intensity, glm::vec3(0.5f));
    EXPECT_EQ(blended->lights[1].intensity, glm::vec3(1.5f));
    EXPECT_EQ(blended->light_names, "sun\nsun\n");
}

TEST(BlendVolumes, OcclusionOfOneScenarioAloneIsKeptForItsLights) {
    const ProbeVolume a = scenario(1.0f);
    ProbeVolume b = scenario(3.0f, {1, 0, 0});
    give_occlusion(b, 0.5f);
    const auto blended = blend_volumes(a.view(), b.view(), 0.5f);
    ASSERT_TRUE(blended) << error_text(blended.error());
    EXPECT_EQ(blended->occlusion, b.occlusion);
    EXPECT_EQ(blended->occlusion_lights[0][1], 1u);  // the second light now
    EXPECT_EQ(blended->light_states[1].channel, 1u);
    EXPECT_TRUE(verify(blended->view()));
}

TEST(BlendVolumes, RefusesWhatDoesNotFit) {
    const ProbeVolume a = scenario(1.0f);
    EXPECT_EQ(error_of(a, a, 1.5f), "a blend of 1.5 is not in [0, 1]");
    EXPECT_EQ(error_of(a, a, std::nanf("")), "a blend of nan is not in [0, 1]");
    EXPECT_EQ(error_of(a, test::make_lit_volume(test::random_positions(14, 1)), 0.5f),
              "the volumes have 15 and 14 probes");
    ProbeVolume b = a;
    b.positions[4].x += 0.5f;
    EXPECT_EQ(error_of(a, b, 0.5f), "probe 4 is not at the same position in both volumes");
    b = a;
    b.irradiance.clear();
    EXPECT_EQ(error_of(a, b, 0.5f), "one of the volumes has light and the other none");
}

TEST(BlendVolumes, RefusesOcclusionOfDifferentLights) {
    ProbeVolume a = scenario(1.0f), b = scenario(1.0f, {1, 0, 0});
    give_occlusion(a, 1.0f);
    give_occlusion(b, 1.0f);
    EXPECT_EQ(error_of(a, b, 0.5f),
              "light \"sun\" has occlusion, and the other volume has that of other lights, or "
              "in another mixed-lighting mode");
}

}  // namespace
}  // namespace tetralight
