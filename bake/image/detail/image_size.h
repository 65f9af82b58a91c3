// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// True if an image is larger than kMaxImagePixels.
[[nodiscard]] bool is_too_large(uint64_t width, uint64_t height) noexcept;

/// Returns unsupported: an image that is read has too many pixels.
[[nodiscard]] Error image_size_error(uint64_t width, uint64_t height);

/// Returns invalid_argument if an image to write has no pixels, or more than kMaxImagePixels.
[[nodiscard]] Status check_writable_size(const std::string& path, uint64_t width, uint64_t height);

}  // namespace tetralight::detail
