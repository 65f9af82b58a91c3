// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/preview_volume.h>

#include <utility>
#include <vector>

#include <tetralight/base/contract.h>
#include <tetralight/pipeline/finish_bake.h>

namespace tetralight {

ProbeVolume preview_volume(const PreparedBake& prepared, const PartialBake& so_far) {
    const size_t count = prepared.capture_positions.size();
    TETRALIGHT_ASSERT(so_far.accumulators.size() == count, "the part is that of all probes");
    PreparedBake copy = prepared;
    copy.reused = ReusedLight();
    const std::vector<bool> is_reused = prepared.reused.flags(count);
    // What the bake does with probes in geometry is its own; here unknown light is what matters.
    if (copy.settings.health.invalid != InvalidProbes::Dilate) copy.is_invalid.assign(count, false);
    copy.settings.health.invalid = InvalidProbes::Dilate;
    for (size_t i = 0; i < count; ++i) {
        const bool is_known = is_reused[i] || so_far.accumulators[i].sample_count > 0;
        if (!is_known) copy.is_invalid[i] = true;
    }
    BakeFinisher bake(std::move(copy));
    bake.add(so_far);
    ProbeVolume volume = std::move(bake).finish().volume;
    volume.metadata = R"({"is_preview":true})";
    return volume;
}

}  // namespace tetralight
