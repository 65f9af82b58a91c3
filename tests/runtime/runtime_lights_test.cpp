// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/runtime_lights.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

/// One tetrahedron around the origin; lights 0 and 1 share channel 2.
ProbeVolume make_volume() {
    ProbeVolume volume;
    volume.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
    volume.cells = {{{0, 1, 2, 3}, {kNoIndex, kNoIndex, kNoIndex, kNoIndex}}};
    volume.lights.resize(2);
    volume.light_states.resize(2);
    for (LightState& state : volume.light_states) {
        state.channel = 2;
        state.mixed_lighting = MixedLighting::Shadowmask;
    }
    volume.occlusion = {glm::vec4(0.25f), glm::vec4(0.75f), glm::vec4(0.0f), glm::vec4(1.0f)};
    const OcclusionLights first{kNoIndex, kNoIndex, 0, kNoIndex};
    const OcclusionLights second{kNoIndex, kNoIndex, 1, kNoIndex};
    volume.occlusion_lights = {first, first, second, second};
    return volume;
}

CellLocation in_the_cell(const glm::vec4& weights) {
    CellLocation location;
    location.cell = 0;
    location.ambient = 0.0f;
    location.weights = weights;
    return location;
}

TEST(RuntimeLights, AreThoseThatAreNotBaked) {
    ProbeVolume volume;
    volume.lights.resize(3);
    volume.lights[0].mode = LightMode::Baked;
    volume.lights[1].mode = LightMode::Realtime;
    const auto lights = runtime_lights(volume.view());
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].index, 1u);
    EXPECT_EQ(lights[1].index, 2u);
    for (const RuntimeLight& light : lights) {
        EXPECT_EQ(light.channel, kNoIndex);
        EXPECT_TRUE(light.lights_moving);
        EXPECT_EQ(light.visibility(glm::vec4(0.0f)), 1.0f);
    }
}

TEST(RuntimeLights, OccludeByTheirChannel) {
    const auto lights = runtime_lights(make_volume().view());
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[1].visibility({0.1f, 0.2f, 0.3f, 0.4f}), 0.3f);
}

TEST(RuntimeLights, AreDimmedByTheirLayer) {
    ProbeVolume volume = make_volume();
    volume.layers.resize(2);
    volume.layers[1].weight = 0.25f;
    volume.light_states[0].layer = 1;
    const auto lights = runtime_lights(volume.view());
    EXPECT_EQ(lights[0].light.intensity, glm::vec3(0.25f));
    EXPECT_EQ(lights[1].light.intensity, glm::vec3(1.0f));
}

TEST(RuntimeLights, OfSubtractiveBakesOnlyTheMainSunLightsWhatMoves) {
    ProbeVolume volume;
    volume.lights.resize(4);
    volume.light_states.resize(4);
    for (LightState& state : volume.light_states) {
        state.mixed_lighting = MixedLighting::Subtractive;
    }
    volume.lights[0].intensity = glm::vec3(2.0f);
    volume.lights[1].intensity = glm::vec3(3.0f);
    volume.lights[2].type = LightType::Point;
    volume.lights[3].mode = LightMode::Realtime;
    const auto lights = runtime_lights(volume.view());
    ASSERT_EQ(lights.size(), 4u);
    EXPECT_FALSE(lights[0].lights_moving);
    EXPECT_TRUE(lights[1].lights_moving);
    EXPECT_FALSE(lights[2].lights_moving);
    EXPECT_TRUE(lights[3].lights_moving);
}

TEST(RuntimeLights, VisibilityIsThatOfTheProbesThatKeepTheLight) {
    const ProbeVolume volume = make_volume();
    const auto lights = runtime_lights(volume.view());
    const CellLocation location = in_the_cell({0.2f, 0.2f, 0.3f, 0.3f});
    EXPECT_FLOAT_EQ(interpolate_visibility(volume.view(), location, lights[0]), 0.5f);
    EXPECT_FLOAT_EQ(interpolate_visibility(volume.view(), location, lights[1]), 0.5f);
    const CellLocation at_first = in_the_cell({1.0f, 0.0f, 0.0f, 0.0f});
    EXPECT_FLOAT_EQ(interpolate_visibility(volume.view(), at_first, lights[0]), 0.25f);
    EXPECT_FLOAT_EQ(interpolate_visibility(volume.view(), at_first, lights[1]), 1.0f);
}

TEST(RuntimeLights, WithoutOcclusionOrACellAllIsVisible) {
    ProbeVolume volume = make_volume();
    const auto lights = runtime_lights(volume.view());
    EXPECT_EQ(interpolate_visibility(volume.view(), CellLocation(), lights[0]), 1.0f);
    volume.occlusion.clear();
    const CellLocation location = in_the_cell({0.5f, 0.5f, 0.0f, 0.0f});
    EXPECT_EQ(interpolate_visibility(volume.view(), location, lights[0]), 1.0f);
}

}  // namespace
}  // namespace tetralight
