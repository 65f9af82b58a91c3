// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The document's materials, in its order, and the textures they use.
struct GltfMaterials {
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Texture> normal_maps;
    /// Materials that are not read as their format defines them.
    std::vector<ScenePart> parts;
    /// Whether the file says that a material is opaque, which may let light through all the same.
    std::vector<bool> ignores_vertex_alpha;
};

[[nodiscard]] Result<GltfMaterials> read_materials(const GltfDocument& document,
                                                   NormalMaps normal_maps);

/// Sets the alpha of vertex colours to 1 where the file says that the material is opaque and it
/// became one with an alpha.
void ignore_vertex_alpha(const GltfMaterials& materials, std::vector<Mesh>& meshes);

/// Gives meshes without a material glTF's default material, which is appended if any mesh needs it.
void assign_default_material(std::vector<Material>& materials, std::vector<Mesh>& meshes);

}  // namespace tetralight::detail
