// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {

/// The light that reaches the surfaces of a scene, known at the texels of its lightmaps: a path
/// that hits one of them takes its light from the texel and ends. Surfaces that are not covered,
/// backs, and texels that a wall crosses have no light here.
struct RadianceCache {
    /// Irradiance of a surface, by how the light arrives.
    struct Irradiance {
        glm::vec3 sun{0.0f};        ///< directly from directional lights
        glm::vec3 sources{0.0f};    ///< directly from all other lights, emission and the sky
        glm::vec3 reflected{0.0f};  ///< by reflections; 0 unless `has_reflected`

        [[nodiscard]] glm::vec3 direct() const { return sun + sources; }
    };

    /// Where the triangles of a mesh lie in texels.
    struct Map {
        uint32_t width = 0;
        std::vector<glm::vec2> corner_uvs;  ///< three a triangle, in texels
        /// Which texel of an instance has the light of each place of the map, row by row, or
        /// kNoIndex.
        std::vector<uint32_t> texels;
    };

    struct Instance {
        uint32_t map = kNoIndex;
        uint32_t first_texel = 0;
        float texel_size = 0.0f;  ///< metres
    };

    /// Texels nearer than this to the start of a ray are not used, in sizes of a texel: there the
    /// light of one point is not that of the texel.
    static constexpr float kLeastDistance = 4.0f;

    std::vector<Map> maps;
    std::vector<Instance> instances;  ///< of the scene
    std::vector<bool> is_trusted;     ///< one a texel
    std::vector<Irradiance> irradiance;
    /// One a texel and layer of the plan, texel by texel.
    std::vector<Irradiance> layer_irradiance;
    size_t layer_count = 0;
    /// False while the cache is made: paths then take direct light from it and continue.
    bool has_reflected = false;

    /// The texel that has the light of a surface, for a ray that starts at `origin`.
    [[nodiscard]] std::optional<uint32_t> find(const Surface& surface, glm::vec3 origin) const;

    /// The light of the layers of a texel.
    [[nodiscard]] std::span<const Irradiance> layers(uint32_t texel) const {
        return std::span(layer_irradiance).subspan(texel * layer_count, layer_count);
    }
};

}  // namespace tetralight
