// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/texture.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// The two texels beside a coordinate and the weight of the second one.
struct TexelPair {
    uint32_t first = 0;
    uint32_t second = 0;
    float second_weight = 0.0f;
};

/// The coordinate in one period, so that a large one neither overflows nor loses its fraction.
float reduced(float coordinate, TextureWrap wrap) {
    if (!std::isfinite(coordinate)) return 0.0f;
    switch (wrap) {
        case TextureWrap::Repeat:
            return coordinate - std::floor(coordinate);
        case TextureWrap::MirroredRepeat:
            return coordinate - 2.0f * std::floor(coordinate * 0.5f);
        case TextureWrap::ClampToEdge:
            break;
    }
    return std::clamp(coordinate, 0.0f, 1.0f);
}

/// Texel index of an index up to one period outside of the image.
uint32_t wrapped(int64_t index, int64_t size, TextureWrap wrap) {
    if (wrap == TextureWrap::ClampToEdge) {
        return static_cast<uint32_t>(std::clamp<int64_t>(index, 0, size - 1));
    }
    const int64_t period = wrap == TextureWrap::Repeat ? size : 2 * size;
    const int64_t inside = index < 0 ? index + period : (index < period ? index : index - period);
    return static_cast<uint32_t>(inside < size ? inside : period - 1 - inside);
}

TexelPair texels_at(float coordinate, uint32_t size, TextureWrap wrap) {
    const float texel = reduced(coordinate, wrap) * static_cast<float>(size) - 0.5f;
    const float floor = std::floor(texel);
    const auto first = static_cast<int64_t>(floor);
    return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap), texel - floor};
}

using Texel = std::array<uint8_t, 4>;

glm::vec4 color_from(const Texel& code) {
    return {linear_from_srgb8(code[0]), linear_from_srgb8(code[1]), linear_from_srgb8(code[2]),
            static_cast<float>(code[3]) / 255.0f};
}

glm::vec4 data_from(const Texel& code) {
    return glm::vec4(code[0], code[1], code[2], code[3]) / 255.0f;
}

glm::vec4 lerp(glm::vec4 first, glm::vec4 second, float second_weight) {
    return first * (1.0f - second_weight) + second * second_weight;
}

/// Decodes four texels and interpolates the decoded values.
template <class Decode>
glm::vec4 filtered(const Texture& texture, glm::vec2 uv, Decode decode) {
    const Image8& image = texture.image;
    TETRALIGHT_ASSERT(!image.pixels.empty(), "a texture has pixels");
    const TexelPair x = texels_at(uv.x, image.width, texture.wrap_u);
    const TexelPair y = texels_at(uv.y, image.height, texture.wrap_v);
    const auto row = [&](uint32_t texel_row) {
        const Texel* texels = &image.pixels[size_t{texel_row} * image.width];
        return lerp(decode(texels[x.first]), decode(texels[x.second]), x.second_weight);
    };
    return lerp(row(y.first), row(y.second), y.second_weight);
}

}  // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
    return filtered(texture, uv, color_from);
}

glm::vec4 sample_data_texture(const Texture& texture, glm::vec2 uv) {
    return filtered(texture, uv, data_from);
}

}  // namespace tetralight
