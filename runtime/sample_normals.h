// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/packed_sh.h>

namespace tetralight {

/// Unit normals as an array for each coordinate.
struct NormalSpans {
    std::span<const float> x, y, z;
};

/// Irradiance / π as an array for each channel.
struct LightSpans {
    std::span<float> red, green, blue;
};

/// `sample_sh9` for many normals under one light. With Highway, vector code that is chosen for the
/// processor at run time; it agrees with `sample_sh9` but for rounding. Precondition: all spans are
/// as long as `normals.x`, and the answers lie in other memory than the normals. Thread-safe.
void sample_sh9(const PackedSh& sh, const NormalSpans& normals, const LightSpans& light) noexcept;

}  // namespace tetralight
