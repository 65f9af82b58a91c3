// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/packed_sh.h>

namespace tetralight {

/// Unit normals, one array per coordinate.
struct NormalSpans {
    std::span<const float> x, y, z;
};

/// Irradiance / π, one array per channel.
struct LightSpans {
    std::span<float> red, green, blue;
};

/// `sample_sh9` for many normals under one light. With Highway it uses vector instructions, chosen
/// for the processor at run time; results differ from `sample_sh9` by rounding. Preconditions: all
/// spans are as long as `normals.x`, and inputs and outputs do not overlap. Thread-safe.
void sample_sh9(const PackedSh& sh, const NormalSpans& normals, const LightSpans& light) noexcept;

}  // namespace tetralight
