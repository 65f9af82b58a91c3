// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/lightmap_textures.h>

#include <glm/vec4.hpp>
#include <vector>

namespace tetralight {
namespace {

/// Where an instance lies in the pages as shaders read it (std430).
struct GlLightmapPlace {
    glm::vec4 rectangle{0.0f};  ///< scale, offset
    /// x: page; y: scale of its halves.
    glm::vec4 page{0.0f};
};

static_assert(sizeof(GlLightmapPlace) == 32);

GlTexture make_pages(const LightmapsView& lightmaps) {
    const auto size = static_cast<GLsizei>(lightmaps.info.page_size);
    const auto count = static_cast<GLsizei>(lightmaps.info.page_count);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    glTextureStorage3D(name, 1, GL_RGBA16F, size, size, count);
    glTextureSubImage3D(name, 0, 0, 0, 0, size, size, count, GL_RGBA, GL_HALF_FLOAT,
                        lightmaps.irradiance.data());
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    return GlTexture(name);
}

}  // namespace

LightmapTextures::LightmapTextures(const LightmapsView& lightmaps,
                                   std::span<const uint32_t> instances) {
    std::vector<GlLightmapPlace> places;
    for (const uint32_t index : instances) {
        GlLightmapPlace& place = places.emplace_back();
        if (index >= lightmaps.rectangles.size()) continue;
        const LightmapRectangle& rectangle = lightmaps.rectangles[index];
        place.rectangle = {rectangle.scale, rectangle.offset};
        place.page = {static_cast<float>(rectangle.page), lightmaps.info.scale, 0.0f, 0.0f};
    }
    places_ = make_gl_buffer(places);
    if (lightmaps.info.page_count > 0) pages_ = make_pages(lightmaps);
}

void LightmapTextures::bind(GLuint places_binding, GLuint pages_unit) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, places_binding, places_.name());
    glBindTextureUnit(pages_unit, pages_.name());
}

}  // namespace tetralight
