// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/gltf_parts.h>
#include <tetralight/bake/scene/detail/lightmap_primitive.h>
#include <tetralight/bake/scene/lightmap_glb.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A node with lightmaps.
struct LightmapObject {
    uint32_t node = 0;
    /// Of its EXT_mesh_gpu_instancing; 1 without.
    size_t transform_count = 1;
    /// For each transform, one place for each primitive of the node's glTF mesh.
    std::vector<GltfLightmapPlace> places;
};

/// The nodes of which an instance has a lightmap. `places` are in the order of `read_instances`.
/// Returns invalid_argument (field "instances") if their number is not that of the instances, or if
/// a node that morph targets or a skin deform has a lightmap.
[[nodiscard]] Result<std::vector<LightmapObject>> lightmap_objects(
    const GltfDocument& document, std::span<const GltfWorldNode> nodes,
    const std::vector<bool>& is_probe, const GltfMeshes& meshes,
    std::span<const GltfLightmapPlace> places);

/// The meshes of a file, in which primitives have lightmap UVs.
class LightmapMeshes {
  public:
    /// Replaces each primitive that has UVs: by those of its first object. Further UVs go into new
    /// meshes. Returns invalid_argument if UVs do not fit the triangles of a node's mesh.
    [[nodiscard]] static Result<LightmapMeshes> write(
        const GltfDocument& document, const GltfMeshes& meshes,
        std::span<const LightmapObject> objects,
        std::span<const std::span<const glm::vec2>> corner_uvs, GltfParts& parts);

    /// A glTF mesh of this primitive alone, with these UVs; kNoIndex for none.
    [[nodiscard]] uint32_t mesh_of(GltfPrimitivePlace place, uint32_t uvs);

    /// The n of the TEXCOORD_n that has the lightmap's UVs.
    [[nodiscard]] uint32_t uv_set(GltfPrimitivePlace place) const {
        return first_.at(place).uv_set;
    }

  private:
    struct First {
        uint32_t uvs = kNoIndex;
        uint32_t uv_set = 1;
    };

    explicit LightmapMeshes(GltfParts& parts) : parts_(&parts) {}

    void add(GltfPrimitivePlace place, uint32_t uvs, LightmapPrimitive primitive);
    [[nodiscard]] std::string mesh_name(GltfPrimitivePlace place, uint32_t uvs) const;

    GltfParts* parts_;
    std::map<GltfPrimitivePlace, First> first_;
    std::map<std::pair<GltfPrimitivePlace, uint32_t>, GltfJson> primitives_;
    std::map<std::pair<GltfPrimitivePlace, uint32_t>, uint32_t> meshes_;
    std::map<GltfPrimitivePlace, uint32_t> copy_count_;
};

}  // namespace tetralight::detail
