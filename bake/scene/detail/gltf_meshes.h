// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The meshes of a scene: one for each primitive that has triangles.
struct GltfMeshes {
    std::vector<Mesh> meshes;
    /// For each glTF mesh, the indices in `meshes` of its primitives.
    std::vector<std::vector<uint32_t>> meshes_of;
    /// For each of `meshes`, the index of its primitive in the glTF mesh.
    std::vector<uint32_t> primitive_of;
    /// One for each mesh that has triangles without area, which are left out.
    std::vector<std::string> warnings;
};

/// Reads all triangle primitives, with tangents if normal maps are read. `material` is kNoIndex if
/// the file names none.
[[nodiscard]] Result<GltfMeshes> read_meshes(const GltfDocument& document, NormalMaps normal_maps);

}  // namespace tetralight::detail
