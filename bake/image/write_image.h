// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Writes an 8-bit RGBA PNG; the old file stays whole on failure.
[[nodiscard]] Status write_png(const std::string& path, const Image8& image);

/// Pairs of a keyword, of 1 to 79 letters and digits, and a text, both Latin-1.
using PngTexts = std::vector<std::pair<std::string, std::string>>;

/// The bytes of an 8-bit RGBA PNG, with texts as tEXt chunks. Returns invalid_argument for images
/// that have no pixels or are too large.
[[nodiscard]] Result<std::vector<std::byte>> encode_png(const Image8& image,
                                                        const PngTexts& texts = {});

/// Writes a 32-bit float OpenEXR file with channels R, G, B and ZIP compression; the old file stays
/// whole on failure.
[[nodiscard]] Status write_exr(const std::string& path, const ImageF& image);

}  // namespace tetralight
