// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <tetralight/bake/scene/surface_color.h>

// Normal maps. A map's tangent space is that of glTF: x along u of the image, y against v, which
// runs downwards, z along the normal. GPU twin: `tetralight_mapped_normal` of
// runtime/shaders/sh.glsl.

namespace tetralight {

/// True if the mesh has a normal map and the texture coordinates for it.
[[nodiscard]] bool has_normal_map(const Scene& scene, const Mesh& mesh);

/// True if the material has a normal map that cannot be shown: the mesh lacks the texture
/// coordinates for it.
[[nodiscard]] bool lacks_normal_map_uvs(const Scene& scene, const Mesh& mesh);

/// True if tangent space is that of the mesh's tangents: it has them, and no texture transform
/// turns or mirrors the image. Else it comes from the UVs. Precondition: `has_normal_map`.
[[nodiscard]] bool uses_tangents(const Scene& scene, const Mesh& mesh);

/// The unit normal of a point in world space with its normal map. `base_normal` is the unit normal
/// without it, on the front of the surface; seen from behind, both are turned around. The axes of
/// tangent space come from the mesh's tangents (`uses_tangents`) or from the UVs of the triangle. z
/// = √max(0, 1 − x² − y²) is made from red and green; then x and y take the scale. Returns
/// `base_normal` without a map, where tangent space is degenerate, and where the vector is 0.
[[nodiscard]] glm::vec3 mapped_normal(const Scene& scene, const MeshPoint& point,
                                      const glm::mat3& world_from_mesh,
                                      const glm::vec3& base_normal);

}  // namespace tetralight
