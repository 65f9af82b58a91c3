// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/probe_volume.h>
#include "tests/conformance/vector_answer.h"

namespace tetralight::conformance {

/// How far answers of a settled position may lie apart: much less than the tolerance of the
/// conformance vectors.
inline constexpr float kSettledLight = 4e-6f;  ///< of the largest light
inline constexpr float kSettledWeight = 1e-5f;

/// Whether any reader that follows docs/how_to_query.md gives this answer: the cell is one of those
/// that contain the position by long double, all of them give the same light, and the last digit of
/// a weight does not change it. Answers by Clamp and Ambient are taken as they are.
[[nodiscard]] bool is_settled(const ProbeVolumeView& volume, const VectorOptions& options,
                              const VectorAnswer& answer, float largest_light);

}  // namespace tetralight::conformance
