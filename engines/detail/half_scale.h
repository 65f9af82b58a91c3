// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/compact_probes.h>

namespace tetralight::detail {

/// What light is divided by before it is stored as half floats: 1 if these hold the largest
/// magnitude well, otherwise as of compact probes.
[[nodiscard]] inline float half_scale(float largest) noexcept {
    const bool fits = !(largest > 0.0f) || (largest >= 0x1p-4f && largest < 0x1p15f);
    return fits ? 1.0f : compact_scale(largest);
}

}  // namespace tetralight::detail
