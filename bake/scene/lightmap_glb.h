// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {

/// The place of an instance's lightmap: uv_page = uv · scale + offset.
struct GltfLightmapPlace {
    /// Index into `GltfLightmaps::corner_uvs`. kNoIndex: the instance has no lightmap.
    uint32_t uvs = kNoIndex;
    uint32_t page = 0;
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};

    bool operator==(const GltfLightmapPlace&) const = default;
};

/// Lightmaps to put into a glTF scene.
struct GltfLightmaps {
    /// UVs in [0, 1] of a rectangle, three for each triangle of a mesh of `Scene::meshes`.
    std::vector<std::span<const glm::vec2>> corner_uvs;
    /// One for each of `Scene::instances`.
    std::vector<GltfLightmapPlace> places;
    /// Encoded images of the pages, PNG. Empty: places are written as extras.
    std::vector<std::vector<std::byte>> pages;
    /// Factor on the light of the pages.
    double intensity = 1.0;
};

/// The glTF scene at `path` that `reading` chooses, with lightmaps, as the bytes of a .glb file
/// with all buffers and images of files in it. Everything else stays: other scenes, materials,
/// animations, extras, extensions, and where nodes stand without an animation.
///
/// - Primitives of instances with lightmaps become indexed triangles with TEXCOORD_1 as floats, or
///   the next free set if a texture of their material uses TEXCOORD_1. Triangles without area are
///   left out, as `read_gltf` leaves them out. Instances with other UVs get copies of the mesh.
/// - Nodes get MX_lightmap (the draft of Third Room) with `pages`, which is
///   E = intensity · 34.49 · a^2.2 · rgb of an sRGB image; without pages
///   `extras.lightmap_rectangle: {page, scale, offset, texCoord}`.
/// - A node whose mesh has several primitives, or that has EXT_mesh_gpu_instancing, gets one child
///   for each, so that instances keep their order.
///
/// Returns the errors of `read_gltf` for what it reads; invalid_argument (field "instances") if the
/// number of places is not that of the scene's instances, and if UVs do not fit the triangles of an
/// instance, which the message names.
[[nodiscard]] Result<std::vector<std::byte>> make_lightmap_glb(const std::string& path,
                                                               const GltfLightmaps& lightmaps,
                                                               const SceneReading& reading = {});

}  // namespace tetralight
