// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

/// "x, y, z" of a vector.
[[nodiscard]] std::string xyz_text(const auto& v) {
    return str_cat(v.x, ", ", v.y, ", ", v.z);
}

}  // namespace tetralight::detail
