// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight::detail {

// Neighbors of cells: 4 · cell + corner.

constexpr uint32_t cell_of(uint32_t neighbor) {
    return neighbor / 4;
}

constexpr uint32_t corner_of(uint32_t neighbor) {
    return neighbor % 4;
}

}  // namespace tetralight::detail
