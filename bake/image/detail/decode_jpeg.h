// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

[[nodiscard]] bool is_jpeg(std::span<const std::byte> bytes);

/// The size in the header of a JPEG. Errors as of `decode_image8`, without a name.
[[nodiscard]] Result<ImageSize> read_jpeg_size(std::span<const std::byte> bytes);

/// Decodes a JPEG, baseline or progressive: grey, YCbCr, RGB, CMYK or YCCK. CMYK is taken as
/// inverted, as Adobe's programs write it; colour profiles are not applied. Damaged and truncated
/// data is an error. Errors as of `decode_image8`, without a name.
[[nodiscard]] Result<Image8> decode_jpeg(std::span<const std::byte> bytes);

}  // namespace tetralight::detail
