// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight {

/// The index that means "none", wherever elements refer to each other by 32-bit index.
inline constexpr uint32_t kNoIndex = 0xffffffffu;

}  // namespace tetralight
