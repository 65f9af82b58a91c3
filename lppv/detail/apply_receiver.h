// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/receiver.h>

namespace tetralight::detail {

/// Prepares plain locations for `blend`: returns the `Walls` to blend them with. Changes weights
/// only for a receiver that needs more than walls, which blending itself knows.
inline Walls apply_receiver(const ProbeVolumeView& volume, std::span<CellLocation> locations,
                            const Receiver& receiver) {
    if (receiver == Receiver{receiver.walls}) return receiver.walls;
    hide_probes(volume, locations, receiver);
    return Walls::Ignore;
}

}  // namespace tetralight::detail
