// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Reads channels R, G, B (or Y alone as grey) of an OpenEXR file as they stand: NaN, infinite and
/// negative values are the caller's to mend. Precondition: read_exr_size() accepts the file.
[[nodiscard]] Result<ImageF> read_exr(const std::string& path);

}  // namespace tetralight::detail
