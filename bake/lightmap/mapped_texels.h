// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_texels.h>

namespace tetralight {

/// Normals of a texel that has a normal map.
inline constexpr size_t kMappedNormals = 4;

/// For each of `baked` (texels of `texels`) `kMappedNormals` unit normals in world space: those of
/// the normal map at places of the texel, about its own normal. They are the texel's own normal
/// where there is no map.
[[nodiscard]] std::vector<glm::vec3> make_mapped_normals(const Scene& scene,
                                                         const LightmapLayout& layout,
                                                         std::span<const TexelMap> maps,
                                                         const LightmapTexels& texels,
                                                         std::span<const uint32_t> baked);

}  // namespace tetralight
