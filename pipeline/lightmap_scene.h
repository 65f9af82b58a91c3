// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

namespace tetralight {

/// Hash of the positions and indices of a mesh (`LightmapMesh::geometry_key`).
[[nodiscard]] uint64_t geometry_key(const Mesh& mesh);

/// Returns invalid_argument (field "scene") unless the lightmaps are those of this scene: one
/// rectangle for each instance, whose mesh has the geometry that was unwrapped. The message names
/// the first object that differs.
[[nodiscard]] Status check_lightmap_scene(const LightmapsView& lightmaps, const Scene& scene);

/// The UVs of a packing from edge to edge of its rectangle (`Lightmaps::corner_uvs`).
[[nodiscard]] std::vector<glm::vec2> unit_uvs(const PackedCharts& charts);

/// The rectangle of an instance, whose mesh is its packing.
[[nodiscard]] LightmapRectangle rectangle_of(const LightmapLayout& layout,
                                             const LightmapPlace& place);

/// The layout of lightmaps, without charts of triangles and warnings. Precondition: the lightmaps
/// are those of the scene.
[[nodiscard]] LightmapLayout layout_of(const LightmapsView& lightmaps, const Scene& scene);

/// Where a point of a triangle lies in the page of its instance. `position`: world, on the
/// triangle. Precondition: the lightmaps are those of the scene, and the instance has a page.
[[nodiscard]] glm::vec2 page_uv_of(const LightmapsView& lightmaps, const Scene& scene,
                                   uint32_t instance, uint32_t triangle,
                                   const glm::dvec3& position);

}  // namespace tetralight
