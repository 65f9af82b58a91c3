// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/lightmap/texel_map.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/texel_surface.h>
#include <tetralight/base/result.h>

namespace tetralight {

struct LightmapTexelSettings {
    /// Light is sampled at up to `grid`² places of a texel, 1 to 4.
    uint32_t grid = 2;
    /// A place is inside geometry if a smaller fraction of its rays hits front faces or nothing
    /// (the tolerance to back faces is 1 − `min_validity`).
    float min_validity = 0.75f;
    /// Number of threads; 0 = all.
    uint32_t thread_count = 0;
};

/// The texels of all instances, in the order of the instances. One element each.
struct LightmapTexels {
    /// World positions on the surface, nearest to the middles of the texels: keys of random
    /// numbers.
    std::vector<glm::dvec3> positions;
    /// Normals, and ranges of `origins`. Texels inside geometry have no origin and are not baked.
    std::vector<TexelSurfaces::Texel> surfaces;
    /// Places of `TexelMap` in front of the surface and outside geometry, offsets from the
    /// position.
    std::vector<glm::vec3> origins;
    /// Fraction of the rays of a texel's places that hit front faces or nothing.
    std::vector<float> validity;
    /// First texel of each instance, and the number of all texels.
    std::vector<uint32_t> first_texel;

    [[nodiscard]] bool is_valid(size_t texel) const { return surfaces[texel].origin_count > 0; }

    [[nodiscard]] TexelSurfaces view() const { return {surfaces, origins}; }
};

/// The maps of all packings of a layout.
[[nodiscard]] std::vector<TexelMap> make_texel_maps(const Scene& scene,
                                                    const LightmapLayout& layout,
                                                    const LightmapTexelSettings& settings);

/// Places the texels of a layout on the surfaces of the scene.
///
/// Normals are the interpolated vertex normals. Places lie in front of triangles by their rounding
/// error, and farther where vertex normals say that the surface is curved outward (Hanika 2021,
/// "Hacking the Shadow Terminator"), so that rays do not meet the facets. Places inside geometry
/// are dropped, and those that a surface hides from the place that sees the fewest surfaces from
/// behind, so that a texel has the light of one side of a wall. A texel without a place takes one
/// up to three quarters of a texel beside it, where a ray along the surface leaves geometry through
/// a back face. Blended surfaces bound no geometry.
///
/// The texels of an instance depend on other instances through these rays alone. Returns
/// out_of_resources if there are 2^32 texels or more.
[[nodiscard]] Result<LightmapTexels> make_lightmap_texels(const Scene& scene,
                                                          const TraceScene& trace_scene,
                                                          const LightmapLayout& layout,
                                                          std::span<const TexelMap> maps,
                                                          const LightmapTexelSettings& settings);

}  // namespace tetralight
