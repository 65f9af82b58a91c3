// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_materials.h>

#include <cmath>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_images.h>
#include <tetralight/bake/scene/detail/gltf_material_members.h>
#include <tetralight/bake/scene/detail/gltf_specular_glossiness.h>
#include <tetralight/bake/scene/detail/gltf_textures.h>
#include <tetralight/bake/scene/detail/gltf_transmission.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/bake/scene/detail/texel_grid.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr const char* kEmissiveStrength =
    ".extensions.KHR_materials_emissive_strength.emissiveStrength";

Result<glm::vec3> emission_from(const GltfMaterial& source) {
    if (source.emissive_strength < 0.0) {
        return Error{ErrorCode::Corrupt, kEmissiveStrength, str_cat(source.emissive_strength),
                     str_cat("emissiveStrength ", source.emissive_strength, " is negative")};
    }
    glm::vec3 emission{};
    for (int channel = 0; channel < 3; ++channel) {
        const double factor = source.emissive_factor[channel];
        if (factor < 0.0) {
            return Error{ErrorCode::Corrupt, str_cat(".emissiveFactor[", channel, "]"),
                         str_cat(factor), str_cat("emissiveFactor ", factor, " is negative")};
        }
        emission[channel] = static_cast<float>(factor * source.emissive_strength);
        if (std::isfinite(emission[channel])) continue;
        return Error{
            ErrorCode::Corrupt, kEmissiveStrength, str_cat(source.emissive_strength),
            str_cat("emission is not finite (", factor, " * ", source.emissive_strength, ")")};
    }
    return emission;
}

Result<AlphaMode> alpha_mode_from(const std::string& mode) {
    if (mode == "OPAQUE") return AlphaMode::Opaque;
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    return Error{ErrorCode::Corrupt, ".alphaMode", quoted_value(mode),
                 str_cat("alphaMode \"", mode, "\" is not OPAQUE, MASK or BLEND")};
}

/// The readers of surfaces, which share decoded and converted textures.
struct SurfaceReaders {
    SurfaceReaders(const GltfDocument& document, GltfImages& images) : textures(document, images) {}

    GltfTextureReader textures;
    SpecularGlossinessReader specular_glossiness{textures};
    TransmissionReader transmission{textures};
};

bool uses_specular_glossiness(const GltfMaterial& source) {
    return source.specular_glossiness && !source.is_unlit;
}

bool uses_transmission(const GltfMaterial& source) {
    return source.transmission && !source.is_unlit;
}

/// Reads the textures that have an effect. The image files of others may be missing.
Status read_metallic_roughness_textures(const GltfMaterial& source, GltfTextureReader& reader,
                                        Material& material) {
    const auto base_color = read_texture_use(source.base_color_texture,
                                             ".pbrMetallicRoughness.baseColorTexture", reader);
    if (!base_color) return base_color.error();
    material.base_color_texture = *base_color;
    const bool uses_factors = material.metallic > 0.0f || material.roughness > 0.0f;
    if (material.is_unlit || !uses_factors) return Ok{};
    const auto factors = read_texture_use(source.metallic_roughness_texture,
                                          ".pbrMetallicRoughness.metallicRoughnessTexture", reader);
    if (!factors) return factors.error();
    material.metallic_roughness_texture = *factors;
    return Ok{};
}

Status read_emission_texture(const GltfMaterial& source, GltfTextureReader& reader,
                             Material& material) {
    if (material.is_unlit || material.emission == glm::vec3(0.0f)) return Ok{};
    const auto emission = read_texture_use(source.emission_texture, ".emissiveTexture", reader);
    if (!emission) return emission.error();
    material.emission_texture = *emission;
    return Ok{};
}

/// Textures, and what is converted with them.
Status read_surface(const GltfMaterial& source, SurfaceReaders& readers, Material& material) {
    const auto reflection =
        uses_specular_glossiness(source)
            ? readers.specular_glossiness.read(*source.specular_glossiness, material)
            : read_metallic_roughness_textures(source, readers.textures, material);
    if (!reflection) return reflection.error();
    const auto emission = read_emission_texture(source, readers.textures, material);
    if (!emission) return emission.error();
    if (!uses_transmission(source)) return Ok{};
    return readers.transmission.read(*source.transmission, material);
}

/// Reads the normal map. Unlit materials have no use for one.
Status read_normal_map(const GltfMaterial& source, GltfTextureReader& reader, Material& material) {
    material.normal_scale = static_cast<float>(source.normal_scale);
    if (!std::isfinite(material.normal_scale)) {
        return Error{ErrorCode::Corrupt, ".normalTexture.scale", str_cat(source.normal_scale),
                     str_cat("normalTexture: scale ", source.normal_scale, " is too large")};
    }
    const auto use = read_texture_use(source.normal_texture, ".normalTexture", reader);
    if (!use) return use.error();
    material.normal_texture = *use;
    return Ok{};
}

Result<bool> bakes_emission_from(const std::string& word) {
    if (word == "baked") return true;
    if (word == "none") return false;
    return Error{ErrorCode::InvalidArgument, ".extras.bake_emission", quoted_value(word),
                 str_cat("extras.bake_emission \"", word, "\" is neither \"none\" nor \"baked\"")};
}

Status read_metallic_roughness_factors(const GltfMaterial& source, Material& material) {
    const auto color = read_factors(source.base_color, ".pbrMetallicRoughness.baseColorFactor");
    if (!color) return color.error();
    const auto metallic = read_factor(source.metallic, ".pbrMetallicRoughness.metallicFactor");
    if (!metallic) return metallic.error();
    const auto roughness = read_factor(source.roughness, ".pbrMetallicRoughness.roughnessFactor");
    if (!roughness) return roughness.error();
    material.base_color = *color;
    material.metallic = *metallic;
    material.roughness = *roughness;
    return Ok{};
}

Status read_alpha(const GltfMaterial& source, Material& material) {
    const auto mode = alpha_mode_from(source.alpha_mode);
    if (!mode) return mode.error();
    material.alpha_mode = *mode;
    material.alpha_cutoff = static_cast<float>(source.alpha_cutoff);
    if (source.alpha_cutoff >= 0.0 && std::isfinite(material.alpha_cutoff)) return Ok{};
    return Error{ErrorCode::Corrupt, ".alphaCutoff", str_cat(source.alpha_cutoff),
                 str_cat("alphaCutoff ", source.alpha_cutoff, " is negative or too large")};
}

Result<Material> read_material(const GltfMaterial& source, SurfaceReaders& readers) {
    Material material;
    material.name = source.name;
    material.is_double_sided = source.is_double_sided;
    material.is_unlit = source.is_unlit;
    const auto bakes_emission = bakes_emission_from(source.bake_emission.value_or("baked"));
    if (!bakes_emission) return bakes_emission.error();
    material.bakes_emission = *bakes_emission;
    if (!uses_specular_glossiness(source)) {
        const auto factors = read_metallic_roughness_factors(source, material);
        if (!factors) return factors.error();
    }
    const auto emission = emission_from(source);
    if (!emission) return emission.error();
    material.emission = *emission;
    const auto alpha = read_alpha(source, material);
    if (!alpha) return alpha.error();
    const auto surface = read_surface(source, readers, material);
    if (!surface) return surface.error();
    return material;
}

/// The table's row of glass that colours light.
void add_colored_glass(const GltfDocument& document, size_t index, PartList& parts) {
    parts.add({PartUse::Approximated,
               "coloured glass",
               0,
               {},
               "light that shines through is not coloured",
               "",
               true},
              gltf_place("material", index, document.materials[index].name));
}

}  // namespace

Result<GltfMaterials> read_materials(const GltfDocument& document, NormalMaps normal_maps) {
    GltfMaterials result;
    GltfImages images(document);
    images.decode_ahead(image_uses(document, normal_maps));
    SurfaceReaders readers(document, images);
    GltfTextureReader normal_reader(document, images);
    PartList parts;
    bool has_converted = false;
    for (size_t i = 0; i < document.materials.size(); ++i) {
        const GltfMaterial& source = document.materials[i];
        auto material = read_material(source, readers);
        if (!material) return in_element(material.error(), "materials", i, source.name);
        if (normal_maps == NormalMaps::Read && !material->is_unlit) {
            const auto status = read_normal_map(source, normal_reader, *material);
            if (!status) return in_element(status.error(), "materials", i, source.name);
        }
        has_converted |= uses_specular_glossiness(source) || uses_transmission(source);
        if (uses_transmission(source) && readers.transmission.is_colored()) {
            add_colored_glass(document, i, parts);
        }
        result.ignores_vertex_alpha.push_back(source.alpha_mode == "OPAQUE");
        result.materials.push_back(std::move(*material));
    }
    result.textures = std::move(readers.textures.textures);
    if (has_converted) drop_unused_textures(result.materials, result.textures);
    result.normal_maps = std::move(normal_reader.textures);
    parts.append(readers.textures.parts.parts());
    parts.append(normal_reader.parts.parts());
    result.parts = parts.parts();
    return result;
}

void ignore_vertex_alpha(const GltfMaterials& materials, std::vector<Mesh>& meshes) {
    for (Mesh& mesh : meshes) {
        if (mesh.material == kNoIndex) continue;
        const bool was_opaque = materials.ignores_vertex_alpha[mesh.material];
        const AlphaMode mode = materials.materials[mesh.material].alpha_mode;
        if (!was_opaque || mode == AlphaMode::Opaque) continue;
        for (glm::vec4& color : mesh.colors) color.a = 1.0f;
    }
}

void assign_default_material(std::vector<Material>& materials, std::vector<Mesh>& meshes) {
    uint32_t default_material = kNoIndex;
    for (Mesh& mesh : meshes) {
        if (mesh.material != kNoIndex) continue;
        if (default_material == kNoIndex) {
            default_material = static_cast<uint32_t>(materials.size());
            materials.emplace_back().name = "default";
        }
        mesh.material = default_material;
    }
}

}  // namespace tetralight::detail
