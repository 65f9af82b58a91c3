// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_transmission.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/scene/detail/gltf_material_members.h>

namespace tetralight::detail {
namespace {

/// Fraction of light that dielectrics mirror at normal incidence.
constexpr float kMirrored = 0.04f;
/// Differences of channels of transmitted light that are not seen.
constexpr float kGrey = 0.02f;

constexpr const char* kTransmissionFactor =
    ".extensions.KHR_materials_transmission.transmissionFactor";
constexpr const char* kTransmissionTexture =
    ".extensions.KHR_materials_transmission.transmissionTexture";

float luminance(glm::vec3 color) {
    return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Sums over the texels of a material.
struct TransmissionSums {
    double opacity = 0.0;
    uint64_t count = 0;
    bool is_colored = false;
};

}  // namespace

PartlyCovering partly_covering(const MetallicColor& color, float transmission) {
    const float dielectric = (1.0f - kMirrored) * (1.0f - color.metallic);
    const float through = dielectric * transmission * std::min(luminance(color.base_color), 1.0f);
    if (!(through > 0.0f)) return {color, 1.0f};
    const float opacity = 1.0f - through;
    const glm::vec3 diffuse = (dielectric * (1.0f - transmission)) * color.base_color;
    const glm::vec3 specular = glm::mix(glm::vec3(kMirrored), color.base_color, color.metallic);
    return {metallic_color(diffuse / opacity, specular / opacity), opacity};
}

/// A material with its textures decoded.
struct TransmissionReader::Source {
    const Material& material;
    float factor = 0.0f;
    TextureUse texture;

    [[nodiscard]] std::array<TextureUse, 3> uses() const {
        return {material.base_color_texture, texture, material.metallic_roughness_texture};
    }

    /// The coordinates of the converted textures; no texture if there is none.
    [[nodiscard]] TextureUse use() const {
        const auto all = uses();
        const auto* found = std::ranges::find_if(
            all, [](const TextureUse& use) { return use.texture != kNoIndex; });
        return found == all.end() ? TextureUse{} : *found;
    }

    /// The alpha of the material where nothing shines through.
    [[nodiscard]] float coverage(float alpha) const {
        switch (material.alpha_mode) {
            case AlphaMode::Opaque:
                break;
            case AlphaMode::Mask:
                return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
            case AlphaMode::Blend:
                return alpha;
        }
        return 1.0f;
    }

    /// Converts a point; `color`, `factors` and `transmission` are texels.
    [[nodiscard]] PartlyCovering at(const glm::vec4& color, const glm::vec4& factors,
                                    const glm::vec4& transmission, TransmissionSums& sums) const {
        const glm::vec3 base_color = glm::vec3(material.base_color * color);
        const float fraction = factor * transmission.r;
        const PartlyCovering result =
            partly_covering({base_color, material.metallic * factors.b}, fraction);
        sums.opacity += result.opacity;
        ++sums.count;
        const auto [least, most] = std::minmax({base_color.r, base_color.g, base_color.b});
        const bool is_colored =
            fraction * (1.0f - material.metallic * factors.b) * (most - least) > kGrey;
        sums.is_colored = sums.is_colored || is_colored;
        return result;
    }

    [[nodiscard]] std::vector<uint32_t> key() const {
        std::vector<uint32_t> result;
        const TextureUse first = use();
        for (const TextureUse& each : uses()) {
            const bool shares =
                each.uv_set == first.uv_set && each.image_from_mesh == first.image_from_mesh;
            result.insert(result.end(), {each.texture, shares});
        }
        for (const float number : {material.base_color.r, material.base_color.g,
                                   material.base_color.b, material.base_color.a, material.metallic,
                                   material.roughness, material.alpha_cutoff, factor}) {
            result.push_back(std::bit_cast<uint32_t>(number));
        }
        result.push_back(static_cast<uint32_t>(material.alpha_mode));
        return result;
    }
};

TransmissionReader::Converted TransmissionReader::convert(const Source& source) {
    std::vector<Texture>& textures = reader_.textures;
    const Material& material = source.material;
    const TexelGrid grid(textures, source.use(), source.uses());
    const GridTexels color = grid.texels(material.base_color_texture, TexelEncoding::Color);
    const GridTexels factors =
        grid.texels(material.metallic_roughness_texture, TexelEncoding::Data);
    const GridTexels transmission = grid.texels(source.texture, TexelEncoding::Data);
    Texture colors_out = grid.empty_texture(), factors_out = grid.empty_texture();
    TransmissionSums sums;
    ConvertedSurface surface;
    for (uint32_t y = 0; y < grid.size().height; ++y) {
        for (uint32_t x = 0; x < grid.size().width; ++x) {
            const glm::vec4 texel = color.at(x, y), factor = factors.at(x, y);
            const PartlyCovering part = source.at(texel, factor, transmission.at(x, y), sums);
            const float alpha = source.coverage(material.base_color.a * texel.a) * part.opacity;
            surface.base_color = {part.color.base_color, alpha};
            surface.metallic = part.color.metallic;
            surface.roughness = material.roughness * factor.g;
            colors_out.image.pixels.push_back(color_code(surface.base_color));
            factors_out.image.pixels.push_back(factors_code(surface.metallic, surface.roughness));
        }
    }
    const double opacity = sums.opacity / static_cast<double>(sums.count);
    if (opacity >= 1.0) return {};
    return {append_converted(surface, std::move(colors_out), std::move(factors_out), textures),
            static_cast<float>(opacity), sums.is_colored};
}

Status TransmissionReader::read(const GltfTransmission& gltf, Material& material) {
    is_colored_ = false;
    const auto factor = read_factor(gltf.factor, kTransmissionFactor);
    if (!factor) return factor.error();
    if (*factor == 0.0f) return Ok{};
    const auto texture = read_texture_use(gltf.texture, kTransmissionTexture, reader_);
    if (!texture) return texture.error();
    const Source source{material, *factor, *texture};
    const std::vector<uint32_t> key = source.key();
    auto known = known_.find(key);
    if (known == known_.end()) known = known_.emplace(key, convert(source)).first;
    const Converted& converted = known->second;
    is_colored_ = converted.is_colored;
    if (converted.opacity >= 1.0f) return Ok{};
    const TextureUse use = source.use();
    set_surface(converted.surface, use, use, material);
    material.emission /= converted.opacity;
    material.alpha_mode = AlphaMode::Blend;
    return Ok{};
}

}  // namespace tetralight::detail
