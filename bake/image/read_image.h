// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Pixels of the largest image that is read or written: 16384². The limit prevents that a small
/// hostile file fills memory.
inline constexpr uint64_t kMaxImagePixels = uint64_t{16384} * 16384;

/// Decodes PNG or JPEG bytes. Error messages begin with `name`. Returns unsupported for other
/// formats and for images that are too large, corrupt if the bytes cannot be decoded.
[[nodiscard]] Result<Image8> decode_image8(std::span<const std::byte> bytes,
                                           const std::string& name);

/// A radiance image, and the number of its pixels that had to be replaced.
struct HdrImage {
    ImageF image;
    /// Pixels of which a channel was NaN or negative (replaced by 0), infinite (replaced by 65504,
    /// the largest finite half), or above 1e30 (replaced by 1e30).
    uint64_t mended_pixel_count = 0;
};

/// Reads a radiance image: Radiance .hdr or OpenEXR .exr (any compression; channels R, G, B).
/// Recognizes the format by the file's first bytes, not by its name. Errors as of `decode_image8`.
[[nodiscard]] Result<HdrImage> read_hdr_image(const std::string& path);

}  // namespace tetralight
