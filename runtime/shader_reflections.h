// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

#include <tetralight/reflection/sample_reflections.h>

// Reflection probes as runtime/shaders/reflection.glsl reads them. Positions are floats relative to
// an origin near the camera, so that they stay exact in large worlds.

namespace tetralight {

/// TetralightReflectionProbe, in std140 and std430.
struct ShaderReflectionProbe {
    glm::vec4 position{0.0f};    ///< w: its place in the array of cubes
    glm::vec4 box_center{0.0f};  ///< relative to the position; w: blend distance
    glm::vec4 half_size{0.0f};   ///< w: 1, or 0 if the probe is used everywhere
    glm::vec4 x_axis{0.0f}, y_axis{0.0f}, z_axis{0.0f};

    bool operator==(const ShaderReflectionProbe&) const = default;
};

static_assert(sizeof(ShaderReflectionProbe) == 96 &&
              std::is_trivially_copyable_v<ShaderReflectionProbe>);

/// TetralightReflectionBlend, in std140 and std430.
struct ShaderReflectionBlend {
    ShaderReflectionProbe first, second, third;
    glm::vec4 weights{0.0f};  ///< w: number of levels - 1

    bool operator==(const ShaderReflectionBlend&) const = default;
};

static_assert(sizeof(ShaderReflectionBlend) == 304 &&
              std::is_trivially_copyable_v<ShaderReflectionBlend>);

/// A probe relative to an origin. `cube`: its place in the array of cubes.
[[nodiscard]] ShaderReflectionProbe make_shader_reflection_probe(const ReflectionProbe& probe,
                                                                 uint32_t cube,
                                                                 const glm::dvec3& origin) noexcept;

/// The blend of an object, for a texture that holds all cubes in their order.
[[nodiscard]] ShaderReflectionBlend make_shader_reflection_blend(const ReflectionsView& reflections,
                                                                 const ReflectionBlend& blend,
                                                                 const glm::dvec3& origin) noexcept;

}  // namespace tetralight
