// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Replaces the light of each invalid probe by the mean light of the valid probes that share a cell
/// with it, weighted by 1 / distance². Repeats with the probes lit so far until no invalid probe
/// has a lit neighbor; those that remain keep their own light. Sets `is_dilated` in `volume.health`
/// and returns the number of dilated probes.
///
/// Weights are positive, so that light that is nowhere negative stays so. Layers, transfer and
/// occlusion take the same weights; occlusion only from probes that store the same light in the
/// channel. Preconditions: the volume has irradiance and health, and there is one flag a probe.
size_t dilate_probes(const std::vector<bool>& is_invalid, ProbeVolume& volume);

}  // namespace tetralight
