// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/proxy_textures.h>

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include <tetralight/lppv/lppv_texture.h>

namespace tetralight {
namespace {

GlTexture make_texture(glm::uvec3 size, const void* texels) {
    const auto x = static_cast<GLsizei>(size.x), y = static_cast<GLsizei>(size.y),
               z = static_cast<GLsizei>(size.z);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &name);
    glTextureStorage3D(name, 1, GL_RGBA32F, x, y, z);
    glTextureSubImage3D(name, 0, 0, 0, 0, x, y, z, GL_RGBA, GL_FLOAT, texels);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    }
    return GlTexture(name);
}

}  // namespace

ProxyTextures::ProxyTextures(const Lppv& lppv, const glm::dvec3& origin) {
    const LppvTexture texture =
        make_lppv_texture(lppv, LppvLayout::SevenSlabs, LppvTexelFormat::Float);
    light_ = make_texture(texture.size, texture.texels.data());
    const std::vector<glm::vec4> lit(lppv.grid.point_count(), glm::vec4(1.0f));
    const auto& occlusion = lppv.occlusion.empty() ? lit : lppv.occlusion;
    occlusion_ = make_texture(lppv.grid.resolution, occlusion.data());
    Lppv moved = lppv;
    moved.grid.world_from_local =
        glm::translate(glm::dmat4(1.0), -origin) * lppv.grid.world_from_local;
    moved.grid.local_from_world =
        lppv.grid.local_from_world * glm::translate(glm::dmat4(1.0), origin);
    const std::vector<LppvConstants> constants{make_lppv_constants(moved, LppvLayout::SevenSlabs)};
    constants_ = make_gl_buffer(constants);
}

void ProxyTextures::bind(GLuint constants_binding, GLuint light_unit, GLuint occlusion_unit) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, constants_binding, constants_.name());
    glBindTextureUnit(light_unit, light_.name());
    glBindTextureUnit(occlusion_unit, occlusion_.name());
}

}  // namespace tetralight
