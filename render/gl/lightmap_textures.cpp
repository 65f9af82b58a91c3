// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/lightmap_textures.h>

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include <tetralight/lightmap/lightmap_texture.h>
#include <tetralight/render/gl/renderer_shaders.h>

namespace tetralight {
namespace {

/// Where an instance lies in the pages as shaders read it (std430).
struct GlLightmapPlace {
    glm::vec4 rectangle{0.0f};  ///< scale, offset
    /// x: page; y: scale of its halves; z: 1 = normal maps have an effect.
    glm::vec4 page{0.0f};
};

static_assert(sizeof(GlLightmapPlace) == 32);

/// How the texels of an array texture are stored.
struct TexelLayout {
    GLenum stored = GL_RGBA16F;
    GLenum channels = GL_RGBA;
    GLenum type = GL_HALF_FLOAT;
};

GlTexture make_pages(uint32_t page_size, uint32_t page_count, const TexelLayout& layout,
                     const void* texels) {
    const auto size = static_cast<GLsizei>(page_size);
    const auto count = static_cast<GLsizei>(page_count);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    glTextureStorage3D(name, 1, layout.stored, size, size, count);
    // Rows of one byte a texel have any length.
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(name, 0, 0, 0, 0, size, size, count, layout.channels, layout.type, texels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    return GlTexture(name);
}

/// Pages of bytes, or a single white texel if there are none.
template <class Texel>
GlTexture make_byte_pages(const LightmapInfo& info, std::span<const Texel> texels) {
    constexpr bool kHasFour = sizeof(Texel) == 4;
    const TexelLayout layout{kHasFour ? GL_RGBA8 : GL_R8, kHasFour ? GL_RGBA : GL_RED,
                             GL_UNSIGNED_BYTE};
    if (!texels.empty()) return make_pages(info.page_size, info.page_count, layout, texels.data());
    constexpr std::array<uint8_t, 4> kWhite{255, 255, 255, 255};
    return make_pages(1, 1, layout, kWhite.data());
}

}  // namespace

LightmapTextures::LightmapTextures(const SceneLight& light, bool has_normal_maps,
                                   std::span<const uint32_t> instances) {
    const LightmapsView& lightmaps = light.lightmaps;
    const bool is_directional =
        has_normal_maps && light.lightmap_light == LightmapLight::Directional;
    const auto directions =
        is_directional ? make_light_texture(lightmaps) : std::vector<TextureHalves>();
    std::vector<GlLightmapPlace> places;
    for (const uint32_t index : instances) {
        GlLightmapPlace& place = places.emplace_back();
        if (index >= lightmaps.rectangles.size()) continue;
        const LightmapRectangle& rectangle = lightmaps.rectangles[index];
        place.rectangle = {rectangle.scale, rectangle.offset};
        place.page = {static_cast<float>(rectangle.page), lightmaps.info.scale,
                      directions.empty() ? 0.0f : 1.0f, 0.0f};
    }
    places_ = make_gl_buffer(places);
    const LightmapInfo& info = lightmaps.info;
    if (info.page_count == 0) return;
    pages_ = make_pages(info.page_size, info.page_count, {}, lightmaps.irradiance.data());
    if (!directions.empty())
        directions_ = make_pages(info.page_size, 3 * info.page_count, {}, directions.data());
    shadow_mask_ = make_byte_pages(info, lightmaps.shadow_mask);
    ambient_occlusion_ = make_byte_pages(
        info, light.has_ambient_occlusion ? lightmaps.ambient_occlusion : std::span<uint8_t>());
}

void LightmapTextures::bind() const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kLightmapPlaceBinding, places_.name());
    glBindTextureUnit(kLightmapUnit, pages_.name());
    glBindTextureUnit(kLightmapLightUnit, directions_.name());
    glBindTextureUnit(kShadowMaskUnit, shadow_mask_.name());
    glBindTextureUnit(kAmbientOcclusionUnit, ambient_occlusion_.name());
}

}  // namespace tetralight
