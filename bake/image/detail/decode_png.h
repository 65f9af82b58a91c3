// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

[[nodiscard]] bool is_png(std::span<const std::byte> bytes);

/// The size in the header of a PNG. Errors as of `decode_image8`, without a name.
[[nodiscard]] Result<ImageSize> read_png_size(std::span<const std::byte> bytes);

/// Decodes a PNG of any kind. Of 16 bits the upper 8 are kept; gamma and colour profiles are not
/// applied. Errors as of `decode_image8`, without a name.
[[nodiscard]] Result<Image8> decode_png(std::span<const std::byte> bytes);

}  // namespace tetralight::detail
