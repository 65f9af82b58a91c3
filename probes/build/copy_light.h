// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Which probes `copy_light` gave light.
struct CopiedLight {
    uint32_t copied_count = 0;
    /// Probes whose position is not in the other volume, ascending.
    std::vector<uint32_t> unlit;
};

/// Copies light from one volume to the probes of another that have exactly the same world position:
/// irradiance, layers, transfer, occlusion and validity, what is known of walls between them
/// (`copy_visibility`), and for the whole volume the ambient light and the lights of the bake. A
/// bake depends on a probe's position and not on other probes, so the copied light is what a new
/// bake of the same scene would give.
///
/// Probes without a twin are unlit until they are baked: no irradiance, occlusion 1, validity 0. An
/// array that is empty in `from` is empty in `to`. Precondition: both have their exact positions.
CopiedLight copy_light(const ProbeVolumeView& from, ProbeVolume& to);

}  // namespace tetralight
