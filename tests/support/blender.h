// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace tetralight::test {

/// True if a `blender` of PATH runs.
inline bool has_blender() {
    return std::system("blender --version > /dev/null 2>&1") == 0;
}

}  // namespace tetralight::test
