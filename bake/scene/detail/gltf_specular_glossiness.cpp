// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_specular_glossiness.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/bake/scene/detail/gltf_material_members.h>

namespace tetralight::detail {
namespace {

/// Reflectivity of dielectrics at normal incidence.
constexpr float kDielectric = 0.04f;
constexpr float kSmallest = 1e-6f;

/// Specular colours up to the first brightness are those of dielectrics, which count as 0.04; from
/// the second on they count as they are.
constexpr float kMostDielectric = 0.08f, kLeastMetal = 0.12f;

constexpr const char* kDiffuseFactor =
    ".extensions.KHR_materials_pbrSpecularGlossiness.diffuseFactor";
constexpr const char* kSpecularFactor =
    ".extensions.KHR_materials_pbrSpecularGlossiness.specularFactor";
constexpr const char* kGlossinessFactor =
    ".extensions.KHR_materials_pbrSpecularGlossiness.glossinessFactor";
constexpr const char* kDiffuseTexture =
    ".extensions.KHR_materials_pbrSpecularGlossiness.diffuseTexture";
constexpr const char* kSpecularTexture =
    ".extensions.KHR_materials_pbrSpecularGlossiness.specularGlossinessTexture";

float perceived_brightness(glm::vec3 color) {
    return std::sqrt(glm::dot(glm::vec3(0.299f, 0.587f, 0.114f), color * color));
}

/// The metallic factor m of a grey material of base colour b:
/// diffuse = 0.96 b (1 − m), specular = 0.04 (1 − m) + b m.
float solve_metallic(float diffuse, float specular) {
    if (specular < kDielectric + kSmallest) return 0.0f;
    const float b = diffuse / (1.0f - kDielectric) + specular - 2.0f * kDielectric;
    const float c = kDielectric - specular;
    const float root = std::sqrt(std::max(b * b - 4.0f * kDielectric * c, 0.0f));
    return std::clamp((root - b) / (2.0f * kDielectric), 0.0f, 1.0f);
}

/// The specular colour with the brightness of dielectrics where it is one.
///
/// A black texel with a specular colour of 0.06 could be a dark metal as well. But beside a white
/// texel of the same dielectric it may not be: of two texels with metallic factors of 0 and 1 the
/// mean of base colour and factor reflects a quarter of the light, not half of it.
glm::vec3 without_dark_metals(glm::vec3 specular) {
    const float brightness = perceived_brightness(specular);
    if (brightness <= kDielectric || brightness >= kLeastMetal) return specular;
    const float t =
        std::max((brightness - kMostDielectric) / (kLeastMetal - kMostDielectric), 0.0f);
    return specular * (glm::mix(kDielectric, brightness, t) / brightness);
}

}  // namespace

MetallicColor metallic_color(glm::vec3 diffuse, glm::vec3 specular) {
    const float metallic =
        solve_metallic(perceived_brightness(diffuse), perceived_brightness(specular));
    const float dielectric = 1.0f - metallic;
    const glm::vec3 of_diffuse = diffuse / ((1.0f - kDielectric) * std::max(dielectric, kSmallest));
    const glm::vec3 of_specular =
        (specular - kDielectric * dielectric) / std::max(metallic, kSmallest);
    return {glm::clamp(glm::mix(of_diffuse, of_specular, metallic * metallic), 0.0f, 1.0f),
            metallic};
}

MetallicColor metallic_color_of_texel(glm::vec3 diffuse, glm::vec3 specular) {
    return metallic_color(diffuse, without_dark_metals(specular));
}

/// A material with its textures decoded.
struct SpecularGlossinessReader::Source {
    glm::vec4 diffuse{1.0f};
    glm::vec3 specular{1.0f};
    float glossiness = 1.0f;
    TextureUse diffuse_texture;
    TextureUse specular_texture;

    /// The coordinates of the converted textures.
    [[nodiscard]] const TextureUse& color_use() const {
        return diffuse_texture.texture != kNoIndex ? diffuse_texture : specular_texture;
    }

    [[nodiscard]] const TextureUse& factors_use() const {
        return specular_texture.texture != kNoIndex ? specular_texture : diffuse_texture;
    }

    [[nodiscard]] MetallicColor color(const glm::vec4& diffuse_texel,
                                      const glm::vec4& specular_texel) const {
        const glm::vec3 mirrored = specular * glm::vec3(specular_texel);
        const float left = 1.0f - std::max({mirrored.r, mirrored.g, mirrored.b});
        return metallic_color_of_texel(left * glm::vec3(diffuse) * glm::vec3(diffuse_texel),
                                       mirrored);
    }

    [[nodiscard]] float roughness(const glm::vec4& specular_texel) const {
        return 1.0f - glossiness * specular_texel.a;
    }

    [[nodiscard]] std::vector<uint32_t> key() const {
        const bool shares = color_use().uv_set == factors_use().uv_set &&
                            color_use().image_from_mesh == factors_use().image_from_mesh;
        std::vector<uint32_t> result{diffuse_texture.texture, specular_texture.texture, shares};
        for (const float factor :
             {diffuse.r, diffuse.g, diffuse.b, specular.r, specular.g, specular.b, glossiness}) {
            result.push_back(std::bit_cast<uint32_t>(factor));
        }
        return result;
    }
};

namespace {

/// A texture with the codes `code_of(diffuse, specular)` of the texels of its sources.
template <class Source, class CodeOf>
Texture converted_texture(const std::vector<Texture>& textures, const Source& source,
                          const TextureUse& use, const CodeOf& code_of) {
    const std::array<TextureUse, 2> uses = {source.diffuse_texture, source.specular_texture};
    const TexelGrid grid(textures, use, uses);
    const GridTexels diffuse = grid.texels(source.diffuse_texture, TexelEncoding::Color);
    const GridTexels specular = grid.texels(source.specular_texture, TexelEncoding::Color);
    Texture result = grid.empty_texture();
    for (uint32_t y = 0; y < grid.size().height; ++y) {
        for (uint32_t x = 0; x < grid.size().width; ++x) {
            result.image.pixels.push_back(code_of(diffuse.at(x, y), specular.at(x, y)));
        }
    }
    return result;
}

}  // namespace

ConvertedSurface SpecularGlossinessReader::convert(const Source& source) {
    ConvertedSurface texel;
    Texture colors = converted_texture(
        reader_.textures, source, source.color_use(),
        [&](const glm::vec4& diffuse, const glm::vec4& specular) {
            texel.base_color = {source.color(diffuse, specular).base_color, diffuse.a};
            return color_code(texel.base_color);
        });
    Texture factors = converted_texture(reader_.textures, source, source.factors_use(),
                                        [&](const glm::vec4& diffuse, const glm::vec4& specular) {
                                            texel.metallic =
                                                source.color(diffuse, specular).metallic;
                                            texel.roughness = source.roughness(specular);
                                            return factors_code(texel.metallic, texel.roughness);
                                        });
    return append_converted(texel, std::move(colors), std::move(factors), reader_.textures);
}

Result<SpecularGlossinessReader::Source> SpecularGlossinessReader::source_from(
    const GltfSpecularGlossiness& gltf) {
    const auto diffuse = read_factors(gltf.diffuse, kDiffuseFactor);
    if (!diffuse) return diffuse.error();
    const auto specular = read_factors(gltf.specular, kSpecularFactor);
    if (!specular) return specular.error();
    const auto glossiness = read_factor(gltf.glossiness, kGlossinessFactor);
    if (!glossiness) return glossiness.error();
    const auto diffuse_texture = read_texture_use(gltf.diffuse_texture, kDiffuseTexture, reader_);
    if (!diffuse_texture) return diffuse_texture.error();
    const auto specular_texture =
        read_texture_use(gltf.specular_glossiness_texture, kSpecularTexture, reader_);
    if (!specular_texture) return specular_texture.error();
    return Source{*diffuse, *specular, *glossiness, *diffuse_texture, *specular_texture};
}

Status SpecularGlossinessReader::read(const GltfSpecularGlossiness& gltf, Material& material) {
    const auto source = source_from(gltf);
    if (!source) return source.error();
    const std::vector<uint32_t> key = source->key();
    auto known = known_.find(key);
    if (known == known_.end()) known = known_.emplace(key, convert(*source)).first;
    set_surface(known->second, source->color_use(), source->factors_use(), material);
    material.base_color.a *= source->diffuse.a;
    return Ok{};
}

}  // namespace tetralight::detail
