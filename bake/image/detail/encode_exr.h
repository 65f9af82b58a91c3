// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>

#include <functional>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The bytes of an OpenEXR file with `header` and the pixels of `source`.
[[nodiscard]] std::string encode_exr(const Imf::Header& header, const Imf::FrameBuffer& source);

/// The bytes that `encode` returns. Returns invalid_argument if OpenEXR cannot encode the image.
[[nodiscard]] Result<std::string> encoded_exr(const std::function<std::string()>& encode);

/// Writes the bytes that `encode` returns; the old file stays whole on failure. Returns
/// invalid_argument if OpenEXR cannot encode the image.
[[nodiscard]] Status write_encoded_exr(const std::string& path,
                                       const std::function<std::string()>& encode);

}  // namespace tetralight::detail
