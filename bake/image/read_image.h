// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Pixels of the largest image that is read or written: 16384². The limit prevents that a small
/// hostile file fills memory.
inline constexpr uint64_t kMaxImagePixels = uint64_t{16384} * 16384;

struct ImageSize {
    uint32_t width = 0;
    uint32_t height = 0;

    bool operator==(const ImageSize&) const = default;
};

/// Reads the size in the header of PNG, JPEG or WebP bytes and decodes nothing. Errors as of
/// `decode_image8`.
[[nodiscard]] Result<ImageSize> read_image_size(std::span<const std::byte> bytes,
                                                const std::string& name);

/// Decodes PNG, JPEG or WebP bytes; recognizes the format by the first of them. Error messages
/// begin with `name`. Returns unsupported for other formats and for images that are too large,
/// corrupt if the bytes cannot be decoded.
[[nodiscard]] Result<Image8> decode_image8(std::span<const std::byte> bytes,
                                           const std::string& name);

/// A radiance image, and the number of its pixels that had to be replaced.
struct HdrImage {
    ImageF image;
    /// Pixels of which a channel was NaN or negative (replaced by 0), infinite (replaced by 65504,
    /// the largest finite half), or above 1e30 (replaced by 1e30).
    uint64_t mended_pixel_count = 0;
};

/// Reads the size in the header of a radiance image. Errors as of `read_hdr_image`.
[[nodiscard]] Result<ImageSize> read_hdr_image_size(const std::string& path);

/// Reads a radiance image: Radiance .hdr or OpenEXR .exr (any compression; channels R, G, B).
/// Recognizes the format by the file's first bytes, not by its name. Errors as of `decode_image8`.
[[nodiscard]] Result<HdrImage> read_hdr_image(const std::string& path);

}  // namespace tetralight
