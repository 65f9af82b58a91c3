// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// True if a file begins as Radiance .hdr files do.
[[nodiscard]] bool is_hdr(std::span<const std::byte> bytes);

/// The size in the header of a Radiance .hdr file. Errors as of `read_hdr_image`, without a name.
[[nodiscard]] Result<ImageSize> read_hdr_size(std::span<const std::byte> bytes);

/// Decodes a Radiance .hdr file: RGBE pixels, flat or run-length encoded in the old or the new way,
/// top row first, from left to right. EXPOSURE and colour correction are not applied. Errors as of
/// `read_hdr_image`, without a name.
[[nodiscard]] Result<ImageF> decode_hdr(std::span<const std::byte> bytes);

}  // namespace tetralight::detail
