// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/radiance_cache.h>

#include <glm/geometric.hpp>

namespace tetralight {

std::optional<uint32_t> RadianceCache::find(const Surface& surface, glm::vec3 origin) const {
    if (surface.instance >= instances.size()) return std::nullopt;
    const Instance& instance = instances[surface.instance];
    if (instance.map == kNoIndex || surface.is_from_behind) return std::nullopt;
    const float least = kLeastDistance * instance.texel_size;
    const glm::vec3 offset = surface.position - origin;
    if (glm::dot(offset, offset) < least * least) return std::nullopt;
    const Map& map = maps[instance.map];
    const glm::vec2* corners = map.corner_uvs.data() + size_t{3} * surface.primitive;
    const glm::vec2 place = corners[0] + (corners[1] - corners[0]) * surface.barycentric.x +
                            (corners[2] - corners[0]) * surface.barycentric.y;
    const size_t index = static_cast<size_t>(place.y) * map.width + static_cast<size_t>(place.x);
    if (!(place.x >= 0.0f && place.y >= 0.0f) || index >= map.texels.size()) return std::nullopt;
    if (map.texels[index] == kNoIndex) return std::nullopt;
    const uint32_t texel = instance.first_texel + map.texels[index];
    if (!is_trusted[texel]) return std::nullopt;
    return texel;
}

}  // namespace tetralight
