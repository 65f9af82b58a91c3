// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_texture_coordinates.h>

#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// A texture that changes the diffuse light of a material.
struct LitTexture {
    const char* name;
    TextureUse use;
    /// How it is read where its coordinates are missing.
    const char* without_coordinates = "is read as white";
};

/// Textures that are converted together with others of the material (TexelGrid).
std::vector<LitTexture> converted_textures(const GltfMaterial& material) {
    std::vector<LitTexture> textures;
    const bool is_glass = material.transmission && material.transmission->factor > 0.0;
    const char* surface = is_glass ? "is not applied, and the surface is opaque"
                                   : "is not applied, and the surface is white metal";
    if (material.specular_glossiness) {
        textures.push_back(
            {"diffuseTexture", material.specular_glossiness->diffuse_texture, surface});
        textures.push_back({"specularGlossinessTexture",
                            material.specular_glossiness->specular_glossiness_texture, surface});
    } else if (is_glass) {
        textures.push_back({"baseColorTexture", material.base_color_texture, surface});
        textures.push_back(
            {"metallicRoughnessTexture", material.metallic_roughness_texture, surface});
    }
    if (is_glass)
        textures.push_back({"transmissionTexture", material.transmission->texture, surface});
    return textures;
}

std::vector<LitTexture> lit_textures(const GltfMaterial& material) {
    if (material.is_unlit) return {{"baseColorTexture", material.base_color_texture}};
    std::vector<LitTexture> textures = converted_textures(material);
    if (textures.empty()) {
        textures.push_back({"baseColorTexture", material.base_color_texture});
        if (material.metallic > 0.0 || material.roughness > 0.0)
            textures.push_back({"metallicRoughnessTexture", material.metallic_roughness_texture});
    }
    if (material.emissive_factor != glm::dvec3(0.0))
        textures.push_back({"emissiveTexture", material.emission_texture});
    return textures;
}

void add_missing(const GltfDocument& document, const GltfPrimitive& primitive,
                 const std::string& mesh, PartList& parts) {
    if (!has_triangles(primitive) || primitive.material == kNoIndex) return;
    const GltfMaterial& material = document.materials[primitive.material];
    const std::string place = gltf_place("material", primitive.material, material.name);
    for (const LitTexture& texture : lit_textures(material)) {
        if (texture.use.texture == kNoIndex) continue;
        if (document.textures[texture.use.texture].image == kNoIndex) continue;  // left out
        const std::string set = str_cat("TEXCOORD_", texture.use.uv_set);
        if (primitive.attributes.contains(set)) continue;
        ScenePart part;
        part.use = PartUse::Ignored;
        part.name = str_cat(texture.name, " of ", place);
        part.note = str_cat(texture.without_coordinates, " where meshes have no ", set);
        part.remedy = str_cat("export the meshes with ", set, ", or take the texture away");
        part.changes_light = true;
        parts.add(part, mesh);
    }
}

}  // namespace

void add_missing_coordinates(const GltfDocument& document, PartList& parts) {
    for (size_t i = 0; i < document.meshes.size(); ++i) {
        const GltfMesh& mesh = document.meshes[i];
        const std::string place = gltf_place("mesh", i, mesh.name);
        for (const GltfPrimitive& primitive : mesh.primitives) {
            add_missing(document, primitive, place, parts);
        }
    }
}

}  // namespace tetralight::detail
