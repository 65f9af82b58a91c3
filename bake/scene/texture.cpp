// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/texture.h>

#include <array>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/scene/detail/texel_pair.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

using Texel = std::array<uint8_t, 4>;

float alpha_from(const Texel& code) {
    return static_cast<float>(code[3]) / 255.0f;
}

glm::vec4 data_from(const Texel& code) {
    return glm::vec4(code[0], code[1], code[2], code[3]) / 255.0f;
}

template <class T>
T lerp(T first, T second, float second_weight) {
    return first * (1.0f - second_weight) + second * second_weight;
}

/// Decodes four texels and interpolates the decoded values.
template <class Decode>
auto filtered(const Texture& texture, glm::vec2 uv, Decode decode) {
    const Image8& image = texture.image;
    TETRALIGHT_ASSERT(!image.pixels.empty(), "a texture has pixels");
    const detail::TexelPair x = detail::texels_at(uv.x, image.width, texture.wrap_u);
    const detail::TexelPair y = detail::texels_at(uv.y, image.height, texture.wrap_v);
    const auto row = [&](uint32_t texel_row) {
        const Texel* texels = &image.pixels[size_t{texel_row} * image.width];
        return lerp(decode(texels[x.first]), decode(texels[x.second]), x.second_weight);
    };
    return lerp(row(y.first), row(y.second), y.second_weight);
}

}  // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
    const std::array<float, 256>& linear = linear_from_srgb8_codes();
    return filtered(texture, uv, [&](const Texel& code) {
        return glm::vec4(linear[code[0]], linear[code[1]], linear[code[2]], alpha_from(code));
    });
}

float sample_texture_alpha(const Texture& texture, glm::vec2 uv) {
    return filtered(texture, uv, alpha_from);
}

glm::vec4 sample_data_texture(const Texture& texture, glm::vec2 uv) {
    return filtered(texture, uv, data_from);
}

}  // namespace tetralight
