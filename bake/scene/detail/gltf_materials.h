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
    std::vector<std::string> warnings;
};

[[nodiscard]] Result<GltfMaterials> read_materials(const GltfDocument& document,
                                                   NormalMaps normal_maps);

/// Gives meshes without a material glTF's default material, which is appended if any mesh needs it.
void assign_default_material(std::vector<Material>& materials, std::vector<Mesh>& meshes);

}  // namespace tetralight::detail
