// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The meshes of a scene: one for each primitive that has triangles.
struct GltfMeshes {
    std::vector<Mesh> meshes;
    /// For each glTF mesh, the indices in `meshes` of its primitives.
    std::vector<std::vector<uint32_t>> meshes_of;
    /// For each glTF node that morph targets or a skin deform, the indices in `meshes` of its own
    /// primitives (pose_meshes()).
    std::map<uint32_t, std::vector<uint32_t>> posed_meshes_of;
    /// For each of `meshes`, the index of its primitive in the glTF mesh.
    std::vector<uint32_t> primitive_of;
    /// Triangles without area are left out.
    PartList parts;

    /// The meshes of a node that has a glTF mesh.
    [[nodiscard]] const std::vector<uint32_t>& meshes_of_node(const GltfDocument& document,
                                                              uint32_t node) const {
        const auto posed = posed_meshes_of.find(node);
        return posed == posed_meshes_of.end() ? meshes_of[document.nodes[node].mesh]
                                              : posed->second;
    }
};

/// Reads all triangle primitives, with tangents if normal maps are read. `material` is kNoIndex if
/// the file names none.
[[nodiscard]] Result<GltfMeshes> read_meshes(const GltfDocument& document, NormalMaps normal_maps);

/// True for lists, strips and fans of triangles.
[[nodiscard]] bool has_triangles(const GltfPrimitive& primitive);

/// Reads a primitive with all of its triangles, those without area among them.
[[nodiscard]] Result<Mesh> read_primitive(const GltfDocument& document,
                                          const GltfPrimitive& primitive, NormalMaps normal_maps);

/// Removes triangles that no ray can hit; returns their number.
size_t remove_flat_triangles(Mesh& mesh);

}  // namespace tetralight::detail
