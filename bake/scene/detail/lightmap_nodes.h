// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_parts.h>
#include <tetralight/bake/scene/detail/lightmap_meshes.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

struct LightmapPages {
    /// The texture of page 0; kNoIndex: places are written as extras.
    uint32_t first_texture = kNoIndex;
    double intensity = 1.0;
};

/// Gives nodes their meshes with lightmap UVs, and the places of their lightmaps.
class LightmapNodes {
  public:
    LightmapNodes(const GltfDocument& document, GltfParts& parts, LightmapMeshes& meshes,
                  const LightmapPages& pages)
        : document_(document), parts_(parts), meshes_(meshes), pages_(pages) {}

    /// Returns the errors of reading the transforms of EXT_mesh_gpu_instancing, and unsupported if
    /// the node has extras that are not an object.
    [[nodiscard]] Status write(const LightmapObject& object);

  private:
    [[nodiscard]] Status write_place(GltfJson& node, GltfPrimitivePlace primitive,
                                     const GltfLightmapPlace& place) const;
    [[nodiscard]] Status write_children(const LightmapObject& object);

    const GltfDocument& document_;
    GltfParts& parts_;
    LightmapMeshes& meshes_;
    LightmapPages pages_;
};

}  // namespace tetralight::detail
