// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/image_size.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

bool is_too_large(uint64_t width, uint64_t height) noexcept {
    return height != 0 && width > kMaxImagePixels / height;
}

Error image_size_error(uint64_t width, uint64_t height) {
    return {ErrorCode::Unsupported,
            str_cat(width, " x ", height, " pixels are more than the largest size (",
                    kMaxImagePixels, " pixels)")};
}

Result<ImageSize> checked_image_size(uint64_t width, uint64_t height) {
    if (width == 0 || height == 0) return Error{ErrorCode::Corrupt, "image is empty"};
    if (is_too_large(width, height)) return image_size_error(width, height);
    // A row or a column of more than 2^32 pixels is too large above.
    return ImageSize{static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

Error decode_error(std::string_view reason) {
    return {ErrorCode::Corrupt, str_cat("cannot decode image (", reason, ")")};
}

Status check_writable_size(const std::string& path, uint64_t width, uint64_t height) {
    if (width > 0 && height > 0 && !is_too_large(width, height)) return Ok{};
    return Error{ErrorCode::InvalidArgument,
                 str_cat(path, ": cannot write an image of ", width, " x ", height, " pixels")};
}

}  // namespace tetralight::detail
