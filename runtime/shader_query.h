// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/probes/locate.h>
#include <tetralight/runtime/shader_volume.h>

// The functions of runtime/shaders/query.glsl on the CPU, for tests and for engines that check
// their shaders: the text of the shader, compiled as C++ with GLM. They compute in floats and read
// the shader's arrays. The queries of the CPU (probes/interpolate.h) compute in double and are
// faster.

namespace tetralight {

/// Finds the cell that contains a world position, and the weights of its probes, with the policy
/// `Extrapolate`. Thread-safe.
[[nodiscard]] CellLocation locate(const ShaderVolume& volume, glm::vec3 position,
                                  uint32_t hint = kNoIndex) noexcept;

/// Blends the probes of a located cell. Thread-safe.
[[nodiscard]] PackedProbe interpolate(const ShaderVolume& volume,
                                      const CellLocation& location) noexcept;

}  // namespace tetralight
