// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// What `copy_light` did with the probes of a volume.
struct CopiedLight {
    uint32_t copied_count = 0;
    /// Probes that were at no position of the other volume, ascending.
    std::vector<uint32_t> unlit;
};

/// Gives the probes of a volume that is not lit the light of those that stand at exactly the same
/// world position in another one: irradiance, layers, transfer, occlusion and validity, and for the
/// whole volume the ambient light and the lights of the bake. A bake depends on a probe's position,
/// not on the other probes, so that what is carried is what a new bake of the same scene would
/// give.
///
/// Probes that find no other are unlit until someone bakes them: no irradiance, occlusion 1,
/// validity 0. Where `from` has no light (or no occlusion, or no validity), neither has `to`.
/// Precondition: both have their exact positions.
CopiedLight copy_light(const ProbeVolumeView& from, ProbeVolume& to);

}  // namespace tetralight
