// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/sights.h>

#include <tetralight/bake/blocked_fraction.h>

namespace tetralight {

bool Sights::sees(uint32_t from, uint32_t to) {
    const uint64_t pair = uint64_t{from} << 32 | to;
    Part& part = parts_[(from * 31 + to) % parts_.size()];
    {
        const std::scoped_lock lock(part.mutex);
        const auto known = part.known.find(pair);
        if (known != part.known.end()) return known->second;
    }
    const glm::vec3 eye = traced_.render_from_world(pool_.position(from));
    const glm::vec3 place = traced_.render_from_world(pool_.position(to));
    const bool is_seen = eye == place || !blocked_fraction(traced_, eye, place);
    ++ray_count_;
    const std::scoped_lock lock(part.mutex);
    part.known[pair] = is_seen;
    return is_seen;
}

}  // namespace tetralight
