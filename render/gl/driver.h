// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/render/image_renderer.h>

// What the OpenGL driver is and can do. A context must be current.

namespace tetralight {

/// What draws, in the driver's words: "llvmpipe (LLVM 15.0.6, 256 bits)".
[[nodiscard]] std::string driver_name();

/// Whether a driver of this name draws on the CPU.
[[nodiscard]] bool is_software(std::string_view driver_name);

/// Pixels along each axis that are drawn for one of a picture: four samples a pixel are what OpenGL
/// promises; more are more pixels.
[[nodiscard]] uint32_t pixels_per_axis(const RenderSettings& settings);

/// Error: a picture that is drawn with so many pixels for one is larger than the driver's textures.
[[nodiscard]] Status check_size(const RenderSettings& settings, uint32_t pixels_per_axis);

}  // namespace tetralight
