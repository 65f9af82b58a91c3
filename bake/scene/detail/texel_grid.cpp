// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/texel_grid.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/scene/texture.h>

namespace tetralight::detail {
namespace {

glm::vec4 decoded(const std::array<uint8_t, 4>& code, TexelEncoding encoding) {
    const glm::vec4 numbers = glm::vec4(code[0], code[1], code[2], code[3]) / 255.0f;
    if (encoding == TexelEncoding::Data) return numbers;
    return {linear_from_srgb8(code[0]), linear_from_srgb8(code[1]), linear_from_srgb8(code[2]),
            numbers.a};
}

glm::vec4 mean_texel(const Image8& image, TexelEncoding encoding) {
    glm::dvec4 sum(0.0);
    for (const auto& code : image.pixels) sum += glm::dvec4(decoded(code, encoding));
    return glm::vec4(sum / static_cast<double>(image.pixels.size()));
}

/// A grid of long textures across and down has at most this many times the texels of one of them.
constexpr uint64_t kMaxGrowth = 4;

uint64_t texel_count(ImageSize size) {
    return uint64_t{size.width} * size.height;
}

uint8_t code_from(float value) {
    return static_cast<uint8_t>(glm::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

bool is_uniform(const Image8& image) {
    return std::ranges::all_of(image.pixels,
                               [&](const auto& code) { return code == image.pixels.front(); });
}

TextureUse with_texture(const TextureUse& coordinates, uint32_t texture) {
    if (texture == kNoIndex) return {};
    TextureUse use = coordinates;
    use.texture = texture;
    return use;
}

}  // namespace

glm::vec4 GridTexels::at(uint32_t x, uint32_t y) const {
    if (texture_ == nullptr) return everywhere_;
    const Image8& image = texture_->image;
    if (image.width == size_.width && image.height == size_.height) {
        return decoded(image.pixels[size_t{y} * image.width + x], encoding_);
    }
    const glm::vec2 center = (glm::vec2(x, y) + 0.5f) / glm::vec2(size_.width, size_.height);
    return encoding_ == TexelEncoding::Color ? sample_texture(*texture_, center)
                                             : sample_data_texture(*texture_, center);
}

TexelGrid::TexelGrid(const std::vector<Texture>& textures, const TextureUse& at,
                     std::span<const TextureUse> uses)
    : textures_(textures), at_(at) {
    ImageSize largest{1, 1};
    for (const TextureUse& use : uses) {
        if (use.texture == kNoIndex || !has_coordinates_of(use)) continue;
        const Image8& image = textures[use.texture].image;
        const ImageSize size{image.width, image.height};
        if (texel_count(size) > texel_count(largest)) largest = size;
        size_.width = std::max(size_.width, size.width);
        size_.height = std::max(size_.height, size.height);
    }
    if (texel_count(size_) > kMaxGrowth * texel_count(largest)) size_ = largest;
}

bool TexelGrid::has_coordinates_of(const TextureUse& use) const {
    const Texture& mine = textures_[at_.texture];
    const Texture& other = textures_[use.texture];
    return use.uv_set == at_.uv_set && use.image_from_mesh == at_.image_from_mesh &&
           other.wrap_u == mine.wrap_u && other.wrap_v == mine.wrap_v;
}

GridTexels TexelGrid::texels(const TextureUse& use, TexelEncoding encoding) const {
    if (use.texture == kNoIndex) return GridTexels(glm::vec4(1.0f));
    const Texture& texture = textures_[use.texture];
    if (has_coordinates_of(use)) return {texture, encoding, size_};
    return GridTexels(mean_texel(texture.image, encoding));
}

Texture TexelGrid::empty_texture() const {
    Texture texture;
    if (at_.texture != kNoIndex) {
        texture.name = textures_[at_.texture].name;
        texture.wrap_u = textures_[at_.texture].wrap_u;
        texture.wrap_v = textures_[at_.texture].wrap_v;
    }
    texture.image = {size_.width, size_.height, {}};
    texture.image.pixels.reserve(size_t{size_.width} * size_.height);
    return texture;
}

std::array<uint8_t, 4> color_code(glm::vec4 color) {
    return {srgb8_from_linear(color.r), srgb8_from_linear(color.g), srgb8_from_linear(color.b),
            code_from(color.a)};
}

std::array<uint8_t, 4> factors_code(float metallic, float roughness) {
    return {0, code_from(roughness), code_from(metallic), 255};
}

ConvertedSurface append_converted(const ConvertedSurface& texel, Texture colors, Texture factors,
                                  std::vector<Texture>& textures) {
    ConvertedSurface result = texel;
    if (!is_uniform(colors.image)) {
        result.base_color = glm::vec4(1.0f);
        result.color_texture = static_cast<uint32_t>(textures.size());
        textures.push_back(std::move(colors));
    }
    if (!is_uniform(factors.image)) {
        result.metallic = 1.0f;
        result.roughness = 1.0f;
        result.factors_texture = static_cast<uint32_t>(textures.size());
        textures.push_back(std::move(factors));
    }
    return result;
}

void set_surface(const ConvertedSurface& surface, const TextureUse& color_use,
                 const TextureUse& factors_use, Material& material) {
    material.base_color = surface.base_color;
    material.base_color_texture = with_texture(color_use, surface.color_texture);
    material.metallic = surface.metallic;
    material.roughness = surface.roughness;
    material.metallic_roughness_texture = with_texture(factors_use, surface.factors_texture);
}

void drop_unused_textures(std::vector<Material>& materials, std::vector<Texture>& textures) {
    const auto each_use = [&](const auto& visit) {
        for (Material& material : materials) {
            for (TextureUse* use :
                 {&material.base_color_texture, &material.metallic_roughness_texture,
                  &material.emission_texture}) {
                if (use->texture != kNoIndex) visit(use->texture);
            }
        }
    };
    std::vector<uint32_t> moved_to(textures.size(), kNoIndex);
    each_use([&](uint32_t texture) { moved_to[texture] = 0; });
    uint32_t count = 0;
    for (size_t i = 0; i < textures.size(); ++i) {
        if (moved_to[i] == kNoIndex) continue;
        moved_to[i] = count;
        if (count != i) textures[count] = std::move(textures[i]);
        ++count;
    }
    textures.resize(count);
    each_use([&](uint32_t& texture) { texture = moved_to[texture]; });
}

}  // namespace tetralight::detail
