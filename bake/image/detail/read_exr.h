// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The size of an OpenEXR file (of its first part) by its header alone.
[[nodiscard]] Result<ImageSize> read_exr_size(const std::string& path);

/// Reads channels R, G, B (or Y alone as grey) of an OpenEXR file as they stand: NaN, infinite and
/// negative values are the caller's to mend.
[[nodiscard]] Result<ImageF> read_exr(const std::string& path);

}  // namespace tetralight::detail
