// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/remove_probes.h>

#include <tetralight/base/contract.h>

namespace tetralight {

MergedProbes remove_probes(MergedProbes probes, const std::vector<bool>& is_removed) {
    TETRALIGHT_ASSERT(is_removed.size() == probes.positions.size(), "one flag a probe");
    std::vector<uint32_t> place(probes.positions.size(), kNoIndex);
    uint32_t count = 0;
    for (uint32_t i = 0; i < place.size(); ++i) {
        if (is_removed[i]) continue;
        place[i] = count;
        probes.positions[count++] = probes.positions[i];
    }
    probes.positions.resize(count);
    for (ProbeSource& source : probes.sources) {
        if (source.probe != kNoIndex) source.probe = place[source.probe];
    }
    return probes;
}

}  // namespace tetralight
