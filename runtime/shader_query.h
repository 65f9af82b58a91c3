// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/receiver.h>
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

/// The cell where a walk without a hint starts; `local` is relative to the volume's origin.
/// Thread-safe.
[[nodiscard]] uint32_t seed_cell(const ShaderVolume& volume, glm::vec3 local) noexcept;

/// The location with weights that know the walls of the volume. Thread-safe.
[[nodiscard]] CellLocation visible_location(const ShaderVolume& volume,
                                            CellLocation location) noexcept;

/// A position moved off the surface that it lies on (probes/receiver.h). Thread-safe.
[[nodiscard]] glm::vec3 push_off_surface(const ShaderVolume& volume, glm::vec3 position,
                                         glm::vec3 normal, const CellLocation& location,
                                         float normal_offset = kNormalOffset) noexcept;

/// Blends the probes of a located cell: `tetralight_interpolate`, or `tetralight_blend` if walls
/// are ignored. Thread-safe.
[[nodiscard]] PackedProbe interpolate(const ShaderVolume& volume, const CellLocation& location,
                                      Walls walls = Walls::HideProbes) noexcept;

}  // namespace tetralight
