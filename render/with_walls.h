// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/receiver.h>

namespace tetralight {

/// The volume for pictures: with `Walls::Ignore` it knows no walls, so that all that takes light
/// from it (surfaces, batches, proxy volumes, shaders) blends with plain weights.
[[nodiscard]] inline ProbeVolumeView with_walls(ProbeVolumeView volume, Walls walls) noexcept {
    if (walls == Walls::HideProbes) return volume;
    volume.visibility_blocks = {};
    volume.cell_visibility = {};
    return volume;
}

}  // namespace tetralight
