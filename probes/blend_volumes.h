// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The light between two scenarios (day and night, doors open and closed) that were baked at the
/// same probes: (1 − t) · a + t · b, for 0 ≤ t ≤ 1. All else is that of `a`.
///
/// Lights that differ in nothing but their intensity are blended; of other lights each scenario's
/// are there, dimmed by its share. Lights of both that have an occlusion channel have to be the
/// same ones. The blended volume has no layers: blend what was recombined.
///
/// Errors: t is out of range; positions or cells differ; one has light and the other none; the
/// occlusion is of different lights.
[[nodiscard]] Result<ProbeVolume> blend_volumes(const ProbeVolumeView& a, const ProbeVolumeView& b,
                                                float t);

}  // namespace tetralight
