// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Largest image that is read, in pixels: 16384², so that a small hostile file cannot fill memory.
inline constexpr uint64_t kMaxImagePixels = uint64_t{16384} * 16384;

/// Decodes PNG or JPEG bytes. `name` stands in error messages only.
[[nodiscard]] Result<Image8> decode_image8(std::span<const std::byte> bytes,
                                           const std::string& name);

/// A radiance image, and how many of its pixels had to be mended.
struct HdrImage {
    ImageF image;
    /// Pixels with a channel that is NaN or negative (it became 0), infinite (the largest finite
    /// half, 65504), or above 1e30 (that).
    uint64_t mended_pixel_count = 0;
};

/// Reads a radiance image: Radiance .hdr or OpenEXR .exr (any compression; channels R, G, B).
/// The kind is told by the file's first bytes, not by its name.
[[nodiscard]] Result<HdrImage> read_hdr_image(const std::string& path);

}  // namespace tetralight
