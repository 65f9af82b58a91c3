// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Probes of a bake that take their light from the volume of an earlier one.
struct ReusedProbes {
    /// The earlier volume. Its owner lives until the bake is finished.
    ProbeVolumeView old;
    /// One a probe of the new volume: the probe of the old one that is taken, or kNoIndex; or
    /// empty.
    std::vector<uint32_t> old_probes;

    [[nodiscard]] bool is_taken(size_t probe) const {
        return !old_probes.empty() && old_probes[probe] != kNoIndex;
    }

    [[nodiscard]] size_t count() const {
        return old_probes.size() - static_cast<size_t>(std::ranges::count(old_probes, kNoIndex));
    }
};

}  // namespace tetralight
