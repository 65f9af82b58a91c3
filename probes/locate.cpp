// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/locate.h>

#include <cmath>

#include <tetralight/base/contract.h>
#include <tetralight/probes/detail/closest_hull_point.h>
#include <tetralight/probes/detail/walk_one.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight {
LocationTrace trace_location(const ProbeVolumeView& volume, glm::vec3 position,
                             uint32_t hint) noexcept {
    if (volume.cells.empty() || !is_finite(position)) return {};
    const uint32_t start = hint < volume.cells.size() ? hint : detail::start_cell(volume, position);
    return detail::walk_one(volume, position, start);
}

CellLocation locate(const ProbeVolumeView& volume, glm::vec3 position, uint32_t hint,
                    const OutsideHull& outside) noexcept {
    TETRALIGHT_ASSERT(outside.fade_distance > 0.0f, "the light fades over a distance");
    const CellLocation location = trace_location(volume, position, hint).location;
    return outside.policy == OutsidePolicy::Extrapolate
               ? location
               : detail::clamp_to_hull(volume, position, location, outside);
}

}  // namespace tetralight
