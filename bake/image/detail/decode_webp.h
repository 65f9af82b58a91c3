// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

[[nodiscard]] bool is_webp(std::span<const std::byte> bytes);

/// The size in the header of a WebP image. Errors as of `decode_image8`, without a name.
[[nodiscard]] Result<ImageSize> read_webp_size(std::span<const std::byte> bytes);

/// Decodes a WebP image, lossy or lossless; animations are not supported. Errors as of
/// `decode_image8`, without a name.
[[nodiscard]] Result<Image8> decode_webp(std::span<const std::byte> bytes);

}  // namespace tetralight::detail
