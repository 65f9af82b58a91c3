// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// True if an image is larger than kMaxImagePixels.
[[nodiscard]] bool is_too_large(uint64_t width, uint64_t height) noexcept;

/// Returns unsupported: an image that is read has too many pixels.
[[nodiscard]] Error image_size_error(uint64_t width, uint64_t height);

/// The size of an image that is read. Returns corrupt if it is empty, unsupported if it has more
/// than kMaxImagePixels.
[[nodiscard]] Result<ImageSize> checked_image_size(uint64_t width, uint64_t height);

/// Returns corrupt: the bytes of an image cannot be decoded for a reason that a library names.
[[nodiscard]] Error decode_error(std::string_view reason);

/// Returns invalid_argument if an image to write has no pixels, or more than kMaxImagePixels.
[[nodiscard]] Status check_writable_size(const std::string& path, uint64_t width, uint64_t height);

}  // namespace tetralight::detail
