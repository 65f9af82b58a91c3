// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_reflections.h>

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

// Offsets of std140 and std430, and of HLSL's constant buffers.
static_assert(offsetof(ShaderReflectionProbe, half_size) == 32);
static_assert(offsetof(ShaderReflectionProbe, z_axis) == 80);
static_assert(offsetof(ShaderReflectionBlend, third) == 192);
static_assert(offsetof(ShaderReflectionBlend, weights) == 288);

TEST(ShaderReflections, ProbesAreRelativeToTheOrigin) {
    const Reflections reflections = test::make_small_reflections();
    const ReflectionProbe& box = reflections.probes[0];
    const auto made = make_shader_reflection_probe(box, 5, {1.0, -2.0, 1e6 - 0.25});
    EXPECT_EQ(made.position, glm::vec4(0.5f, -0.25f, 0.25f, 5.0f));
    EXPECT_EQ(made.box_center, glm::vec4(0.25f, 0.5f, -0.125f, 0.5f));
    EXPECT_EQ(made.half_size, glm::vec4(2.0f, 1.0f, 3.5f, 1.0f));
    EXPECT_EQ(made.y_axis, glm::vec4(box.axes[1], 0.0f));
    const auto sky = make_shader_reflection_probe(reflections.probes[1], 1, {0, 0, 0});
    EXPECT_EQ(sky.half_size, glm::vec4(0.0f));  // GPUs may lack infinity
}

TEST(ShaderReflections, BlendsHaveTheProbesOfTheirWeights) {
    const Reflections reflections = test::make_small_reflections();
    ReflectionBlend blend;
    blend.probes = {1, 0, 77};
    blend.weights = {0.25f, 0.75f, 0.5f};
    const auto made = make_shader_reflection_blend(reflections.view(), blend, {0, 0, 0});
    EXPECT_EQ(made.first, make_shader_reflection_probe(reflections.probes[1], 1, {0, 0, 0}));
    EXPECT_EQ(made.second, make_shader_reflection_probe(reflections.probes[0], 0, {0, 0, 0}));
    EXPECT_EQ(made.weights, glm::vec4(0.25f, 0.75f, 0.0f, 1.0f));  // of two levels; no probe 77
    EXPECT_EQ(make_shader_reflection_blend({}, {}, {0, 0, 0}), ShaderReflectionBlend{});
}

}  // namespace
}  // namespace tetralight
