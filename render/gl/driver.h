// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/render/image_renderer.h>

// Name and limits of the OpenGL driver. A context must be current.

namespace tetralight {

/// The name of the renderer as the driver reports it: "llvmpipe (LLVM 15.0.6, 256 bits)".
[[nodiscard]] std::string driver_name();

/// True if a driver of this name renders on the CPU.
[[nodiscard]] bool is_software(std::string_view driver_name);

/// Number of drawn pixels along each axis for one pixel of the picture. OpenGL guarantees four
/// samples a pixel; more samples need more pixels.
[[nodiscard]] uint32_t pixels_per_axis(const RenderSettings& settings);

/// Returns invalid_argument if the picture, with so many drawn pixels for one along each axis, is
/// larger than the driver's textures.
[[nodiscard]] Status check_size(const RenderSettings& settings, uint32_t pixels_per_axis);

}  // namespace tetralight
