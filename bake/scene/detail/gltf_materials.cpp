// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_materials.h>

#include <cmath>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_images.h>
#include <tetralight/bake/scene/detail/gltf_textures.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kUvSetCount = 2;

Result<float> factor_from(double value, const char* name) {
    if (value >= 0.0 && value <= 1.0) return static_cast<float>(value);
    return Error{ErrorCode::Corrupt, str_cat(".pbrMetallicRoughness.", name), str_cat(value),
                 str_cat(name, " ", value, " is not in 0 to 1")};
}

Result<glm::vec4> base_color_from(const GltfMaterial& source) {
    glm::vec4 color{};
    for (int channel = 0; channel < 4; ++channel) {
        const auto factor = factor_from(source.base_color[channel], "baseColorFactor");
        if (!factor) return factor.error();
        color[channel] = *factor;
    }
    return color;
}

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

bool is_finite(const glm::mat3& matrix) {
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (!std::isfinite(matrix[column][row])) return false;
        }
    }
    return true;
}

/// The same use with an index of the scene's textures. `path` is the texture's member of the
/// material, whose last part is `name`.
Result<TextureUse> texture_use_from(TextureUse use, const char* path, GltfTextureReader& reader) {
    if (use.texture == kNoIndex) return use;
    const std::string name = path + std::string_view(path).rfind('.') + 1;
    if (use.uv_set >= kUvSetCount) {
        return Error{ErrorCode::Unsupported, str_cat(path, ".texCoord"), str_cat(use.uv_set),
                     str_cat(name, ": texCoord ", use.uv_set, " is not supported (0 and 1 are)")};
    }
    if (!is_finite(use.image_from_mesh)) {
        return Error{ErrorCode::Corrupt, str_cat(path, ".extensions.KHR_texture_transform"), "",
                     str_cat(name, ": KHR_texture_transform is not finite")};
    }
    const auto texture = reader.read(use.texture);
    if (!texture) return texture.error().in(name);
    use.texture = *texture;
    return use;
}

/// Reads the textures that have an effect. The image files of others may be missing.
Status read_textures(const GltfMaterial& source, GltfTextureReader& reader, Material& material) {
    const auto base_color = texture_use_from(source.base_color_texture,
                                             ".pbrMetallicRoughness.baseColorTexture", reader);
    if (!base_color) return base_color.error();
    material.base_color_texture = *base_color;
    if (material.is_unlit) return Ok{};
    if (material.metallic > 0.0f || material.roughness > 0.0f) {
        const auto factors =
            texture_use_from(source.metallic_roughness_texture,
                             ".pbrMetallicRoughness.metallicRoughnessTexture", reader);
        if (!factors) return factors.error();
        material.metallic_roughness_texture = *factors;
    }
    if (material.emission == glm::vec3(0.0f)) return Ok{};
    const auto emission = texture_use_from(source.emission_texture, ".emissiveTexture", reader);
    if (!emission) return emission.error();
    material.emission_texture = *emission;
    return Ok{};
}

/// Reads the normal map. Unlit materials have no use for one.
Status read_normal_map(const GltfMaterial& source, GltfTextureReader& reader, Material& material) {
    material.normal_scale = static_cast<float>(source.normal_scale);
    if (!std::isfinite(material.normal_scale)) {
        return Error{ErrorCode::Corrupt, ".normalTexture.scale", str_cat(source.normal_scale),
                     str_cat("normalTexture: scale ", source.normal_scale, " is too large")};
    }
    const auto use = texture_use_from(source.normal_texture, ".normalTexture", reader);
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

Status read_factors(const GltfMaterial& source, Material& material) {
    const auto base_color = base_color_from(source);
    if (!base_color) return base_color.error();
    const auto metallic = factor_from(source.metallic, "metallicFactor");
    if (!metallic) return metallic.error();
    const auto roughness = factor_from(source.roughness, "roughnessFactor");
    if (!roughness) return roughness.error();
    const auto emission = emission_from(source);
    if (!emission) return emission.error();
    material.base_color = *base_color;
    material.metallic = *metallic;
    material.roughness = *roughness;
    material.emission = *emission;
    return Ok{};
}

Result<Material> read_material(const GltfMaterial& source, GltfTextureReader& reader) {
    Material material;
    material.name = source.name;
    material.is_double_sided = source.is_double_sided;
    material.is_unlit = source.is_unlit;
    const auto bakes_emission = bakes_emission_from(source.bake_emission.value_or("baked"));
    if (!bakes_emission) return bakes_emission.error();
    material.bakes_emission = *bakes_emission;
    const auto factors = read_factors(source, material);
    if (!factors) return factors.error();
    const auto alpha_mode = alpha_mode_from(source.alpha_mode);
    if (!alpha_mode) return alpha_mode.error();
    material.alpha_mode = *alpha_mode;
    material.alpha_cutoff = static_cast<float>(source.alpha_cutoff);
    if (!(source.alpha_cutoff >= 0.0) || !std::isfinite(material.alpha_cutoff)) {
        return Error{ErrorCode::Corrupt, ".alphaCutoff", str_cat(source.alpha_cutoff),
                     str_cat("alphaCutoff ", source.alpha_cutoff, " is negative or too large")};
    }
    const auto textures = read_textures(source, reader, material);
    if (!textures) return textures.error();
    return material;
}

}  // namespace

Result<GltfMaterials> read_materials(const GltfDocument& document, NormalMaps normal_maps) {
    GltfMaterials result;
    GltfImages images(document);
    images.decode_ahead(image_uses(document, normal_maps));
    GltfTextureReader reader(document, images), normal_reader(document, images);
    for (size_t i = 0; i < document.materials.size(); ++i) {
        const GltfMaterial& source = document.materials[i];
        auto material = read_material(source, reader);
        if (!material) return in_element(material.error(), "materials", i, source.name);
        if (normal_maps == NormalMaps::Read && !material->is_unlit) {
            const auto status = read_normal_map(source, normal_reader, *material);
            if (!status) return in_element(status.error(), "materials", i, source.name);
        }
        result.materials.push_back(std::move(*material));
    }
    result.textures = std::move(reader.textures);
    result.normal_maps = std::move(normal_reader.textures);
    result.warnings = std::move(reader.warnings);
    result.warnings.insert(result.warnings.end(), normal_reader.warnings.begin(),
                           normal_reader.warnings.end());
    return result;
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
