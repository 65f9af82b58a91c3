// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/probes/locate.h>
#include <tetralight/runtime/shader_volume.h>

// The functions of runtime/shaders/query.glsl on the CPU, for tests and for engines that check what
// their shaders do. They are the shader's own text, compiled as C++ with GLM: in floats, from the
// shader's arrays. Queries of the CPU are in probes/interpolate.h: in double, and faster.

namespace tetralight {

/// Finds the cell that holds a world position, and the weights of its probes, always with the
/// policy `Extrapolate`. Thread-safe.
[[nodiscard]] CellLocation locate(const ShaderVolume& volume, glm::vec3 position,
                                  uint32_t hint = kNoIndex) noexcept;

/// Blends the probes of a located cell. Thread-safe.
[[nodiscard]] PackedProbe interpolate(const ShaderVolume& volume,
                                      const CellLocation& location) noexcept;

}  // namespace tetralight
