// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace tetralight {

struct RadianceCache;

/// The part of a surface that one texel of a lightmap covers.
struct TexelSurface {
    /// Unit shading normal. The light of its hemisphere counts.
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    /// Offsets from the position of the texel at which paths start, metres; at least one. They lie
    /// on the surface within the texel, outside walls, and in front of it by its rounding error.
    std::span<const glm::vec3> origins;
};

/// The surfaces of many texels, whose origins lie in one array.
struct TexelSurfaces {
    struct Texel {
        glm::vec3 normal{0.0f, 0.0f, 1.0f};
        uint32_t first_origin = 0;
        uint32_t origin_count = 0;
    };

    std::span<const Texel> texels;
    std::span<const glm::vec3> origins;
    /// Where paths end (`PathTracer`); null = they are traced to their own ends. `BakeHooks::begin`
    /// can fill it.
    const RadianceCache* cache = nullptr;
    /// Of all that the cache is made of beside the scene and the settings of the bake.
    uint64_t cache_key = 0;

    [[nodiscard]] TexelSurface operator[](size_t i) const {
        return {texels[i].normal, origins.subspan(texels[i].first_origin, texels[i].origin_count)};
    }
};

}  // namespace tetralight
