// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Gives invalid probes the light of the valid ones that they share a cell with, by weights
/// 1 / distance²; then those that had no such neighbor the light of these, and so on. Marks them in
/// `volume.health` and returns how many they are; probes that no valid one reaches keep their own.
/// Weights are positive, so that what is nowhere negative stays so. Layers, transfer and occlusion
/// take the same weights, the latter of probes that keep the same light in a channel.
/// Preconditions: the volume has irradiance and health, and one flag a probe.
size_t dilate_probes(const std::vector<bool>& is_invalid, ProbeVolume& volume);

}  // namespace tetralight
