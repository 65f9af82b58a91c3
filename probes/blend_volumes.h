// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The light between two scenarios (day and night, doors open and closed) that were baked at the
/// same probes: (1 − t) · a + t · b, for 0 ≤ t ≤ 1. All else is that of `a`.
///
/// Lights that differ only in intensity become one; all other lights of both scenarios are kept,
/// scaled by 1 − t or t. Lights with an occlusion channel have to be the same in both. The blended
/// volume has no layers: recombine before blending.
///
/// Returns invalid_argument if t is out of range, positions or cells differ, only one volume has
/// light, or the occlusion is of different lights.
[[nodiscard]] Result<ProbeVolume> blend_volumes(const ProbeVolumeView& a, const ProbeVolumeView& b,
                                                float t);

}  // namespace tetralight
