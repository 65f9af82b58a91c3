// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Writes an 8-bit RGBA PNG; the old file stays whole on failure.
[[nodiscard]] Status write_png(const std::string& path, const Image8& image);

/// Writes a 32-bit float OpenEXR file with channels R, G, B and ZIP compression; the old file stays
/// whole on failure.
[[nodiscard]] Status write_exr(const std::string& path, const ImageF& image);

}  // namespace tetralight
