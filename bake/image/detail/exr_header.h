// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The size of an OpenEXR file by its headers (of the first part, if there are several). Checks
/// that all attributes lie in the file: OpenEXR allocates as much memory as they say. Errors as of
/// `read_hdr_image`, without a name.
[[nodiscard]] Result<ImageSize> read_exr_size(std::span<const std::byte> bytes);

}  // namespace tetralight::detail
