// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/bake/image/image.h>
#include <tetralight/reflection/reflections.h>

// Cubes of reflection probes as images for other programs: radiance in the units of the lights.

namespace tetralight {

/// The six faces of a cube, one below the other: +X, -X, +Y, -Y, +Z, -Z. Preconditions: probe and
/// level exist.
[[nodiscard]] ImageF cube_strip(const ReflectionsView& reflections, size_t probe, uint32_t level);

/// The most that RGBD holds.
inline constexpr float kLargestRgbd = 255.0f;

/// Encodes light up to 255 as RGBD: light = rgb^2.2 / a, r, g, b and a in [0, 1]. More is clamped.
/// A largest channel of 0.25 or more is rounded to 1 % of its value, one of 0.01 to 4 %.
[[nodiscard]] Image8 encode_rgbd(const ImageF& light);

/// The light of one pixel. Precondition: alpha is above 0.
[[nodiscard]] glm::vec3 decode_rgbd(std::array<uint8_t, 4> pixel);

}  // namespace tetralight
