// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_parts.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A primitive with the UVs of its lightmap.
struct LightmapPrimitive {
    GltfJson json;
    /// The UVs are TEXCOORD_n: 1, or more if a texture of the material uses TEXCOORD_1.
    uint32_t uv_set = 1;
};

/// A primitive of a file: its JSON, and the accessors that its attributes are read from, which are
/// others than those of the JSON where compressed primitives share accessors.
struct SourcePrimitive {
    const GltfJson& json;
    const GltfPrimitive& read;
};

/// The primitive as indexed triangles, those of `mesh`, with `corner_uvs`, three a triangle. A
/// vertex with several UVs becomes several vertices; all other attributes and morph targets are
/// copied as they are. A TEXCOORD_1 that no texture uses is replaced.
///
/// Returns unsupported for attributes that are matrices, and corrupt if an attribute has another
/// number of elements than POSITION.
[[nodiscard]] Result<LightmapPrimitive> make_lightmap_primitive(
    const GltfDocument& document, GltfParts& parts, const SourcePrimitive& primitive,
    const Mesh& mesh, std::span<const glm::vec2> corner_uvs);

}  // namespace tetralight::detail
