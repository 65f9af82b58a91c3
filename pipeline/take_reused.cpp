// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/take_reused.h>

#include <span>

namespace tetralight {
namespace {

/// Copies values, one a probe, of the probes that are taken; nothing when there are none.
template <class T>
void take(const ReusedProbes& reused, std::span<const T> from, std::span<T> to) {
    if (from.empty()) return;
    for (size_t i = 0; i < reused.old_probes.size(); ++i) {
        if (reused.is_taken(i)) to[i] = from[reused.old_probes[i]];
    }
}

}  // namespace

void take_reused(const ReusedProbes& reused, ProbeVolume& volume) {
    const ProbeVolumeView& old = reused.old;
    take(reused, old.irradiance, std::span(volume.irradiance));
    take(reused, old.validity, std::span(volume.validity));
    take(reused, old.occlusion, std::span(volume.occlusion));
    take(reused, old.transfer, std::span(volume.transfer));
    const size_t old_count = old.positions.size();
    const size_t count = volume.positions.size();
    for (size_t layer = 0; layer < old.layers.size(); ++layer) {
        take(reused, old.layer_irradiance.subspan(layer * old_count, old_count),
             std::span(volume.layer_irradiance).subspan(layer * count, count));
    }
}

void take_reused(const ReusedProbes& reused, BakedProbes& baked) {
    for (size_t i = 0; i < reused.old_probes.size(); ++i) {
        if (!reused.is_taken(i)) continue;
        baked.standard_error[i] = reused.old.health[reused.old_probes[i]].standard_error;
    }
}

}  // namespace tetralight
