// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/scene/scene.h>

// Textures of a material texel by texel, for conversions that combine several of them.

namespace tetralight::detail {

/// What the codes of a texture mean: sRGB colour with linear alpha, or linear numbers.
enum class TexelEncoding : uint8_t { Color, Data };

/// The texels of one texture in an image of another size, filtered bilinearly, or one value
/// everywhere.
class GridTexels {
  public:
    explicit GridTexels(glm::vec4 everywhere) : everywhere_(everywhere) {}

    GridTexels(const Texture& texture, TexelEncoding encoding, ImageSize size)
        : texture_(&texture), encoding_(encoding), size_(size) {}

    [[nodiscard]] glm::vec4 at(uint32_t x, uint32_t y) const;

  private:
    const Texture* texture_ = nullptr;
    TexelEncoding encoding_ = TexelEncoding::Data;
    ImageSize size_;
    glm::vec4 everywhere_{1.0f};
};

/// The texels of a converted texture, whose coordinates are those of one of its sources. Refers to
/// the textures.
class TexelGrid {
  public:
    /// `at` has the coordinates, or no texture if none of `uses` has one. The grid is as large as
    /// the largest texture of `uses` with the same coordinates, in each direction, if that is at
    /// most four times their texels; otherwise as large as the one with the most texels.
    TexelGrid(const std::vector<Texture>& textures, const TextureUse& at,
              std::span<const TextureUse> uses);

    [[nodiscard]] ImageSize size() const { return size_; }

    /// Texels of a texture: where it has other coordinates, its mean; where there is none, 1.
    [[nodiscard]] GridTexels texels(const TextureUse& use, TexelEncoding encoding) const;

    /// A texture of this size without its image, with the name and the wrap modes of `at`.
    [[nodiscard]] Texture empty_texture() const;

  private:
    [[nodiscard]] bool has_coordinates_of(const TextureUse& use) const;

    const std::vector<Texture>& textures_;
    TextureUse at_;
    ImageSize size_{1, 1};
};

/// 8-bit codes of a linear colour, encoded as sRGB, and alpha.
[[nodiscard]] std::array<uint8_t, 4> color_code(glm::vec4 color);

/// 8-bit codes of a roughness (green) and a metallic factor (blue).
[[nodiscard]] std::array<uint8_t, 4> factors_code(float metallic, float roughness);

/// What a conversion makes of a material, for all materials that convert the same.
struct ConvertedSurface {
    /// Factors; 1 beside textures.
    glm::vec4 base_color{1.0f};
    float metallic = 1.0f;
    float roughness = 1.0f;
    /// Indices of textures, or kNoIndex.
    uint32_t color_texture = kNoIndex;
    uint32_t factors_texture = kNoIndex;
};

/// Appends the converted textures, but not those whose texels are all alike: for them the factors
/// of `texel` count, which are those of any texel.
[[nodiscard]] ConvertedSurface append_converted(const ConvertedSurface& texel, Texture colors,
                                                Texture factors, std::vector<Texture>& textures);

/// Gives a material a converted surface, with the coordinates of its two textures.
void set_surface(const ConvertedSurface& surface, const TextureUse& color_use,
                 const TextureUse& factors_use, Material& material);

/// Removes the textures that no material uses.
void drop_unused_textures(std::vector<Material>& materials, std::vector<Texture>& textures);

}  // namespace tetralight::detail
