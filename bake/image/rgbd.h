// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/bake/image/image.h>

// RGBD, in which the glTF extension EXT_lights_image_based holds light: light = rgb^2.2 / a, with
// r, g, b and a in [0, 1].

namespace tetralight {

/// The most that RGBD holds.
inline constexpr float kLargestRgbd = 255.0f;

/// 1, or the power of two by which light is divided so that its largest channel fits into RGBD.
[[nodiscard]] float intensity_for_rgbd(float largest_channel);

/// Encodes light up to 255; more is clamped. A largest channel of 0.25 or more is rounded to 1 % of
/// its value, one of 0.01 to 4 %.
[[nodiscard]] Image8 encode_rgbd(const ImageF& light);

/// The light of one pixel. An alpha of 0 is read as 1/255, the smallest one that divides.
[[nodiscard]] glm::vec3 decode_rgbd(std::array<uint8_t, 4> pixel);

/// The light of an image. One without alpha has light up to 1.
[[nodiscard]] ImageF decode_rgbd(const Image8& image);

}  // namespace tetralight
