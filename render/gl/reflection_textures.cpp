// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/reflection_textures.h>

#include <glm/vec2.hpp>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/reflection/sample_reflections.h>
#include <tetralight/reflection/split_sum.h>
#include <tetralight/render/gl/renderer_shaders.h>
#include <tetralight/runtime/shader_reflections.h>

namespace tetralight {
namespace {

/// A probe as shaders read it (std430).
struct GlReflectionProbe {
    ShaderReflectionProbe probe;
    PackedSh irradiance{};
};

static_assert(sizeof(GlReflectionProbe) == 208);

Status check_limits(const ReflectionsView& reflections) {
    GLint layers = 0, size = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    glGetIntegerv(GL_MAX_CUBE_MAP_TEXTURE_SIZE, &size);
    const auto cubes = static_cast<size_t>(layers) / 6;
    if (reflections.probes.size() > cubes) {
        return Error{ErrorCode::Unsupported,
                     str_cat("OpenGL: holds ", cubes, " reflection probes, not ",
                             reflections.probes.size())};
    }
    if (reflections.size > static_cast<uint32_t>(size)) {
        return Error{ErrorCode::Unsupported, str_cat("OpenGL: holds cubes of ", size,
                                                     " texels, not of ", reflections.size)};
    }
    return Ok{};
}

GlTexture make_cubes(const ReflectionsView& reflections) {
    const auto levels = static_cast<GLsizei>(reflections.level_count);
    const auto size = static_cast<GLsizei>(reflections.size);
    const auto faces = static_cast<GLsizei>(6 * reflections.probes.size());
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_CUBE_MAP_ARRAY, 1, &name);
    glTextureStorage3D(name, levels, GL_RGBA16F, size, size, faces);
    for (GLint level = 0; level < levels; ++level) {
        glTextureSubImage3D(name, level, 0, 0, 0, size >> level, size >> level, faces, GL_RGBA,
                            GL_HALF_FLOAT, reflections.levels[static_cast<size_t>(level)].data());
    }
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return GlTexture(name);
}

GlTexture make_split_sum() {
    constexpr GLsizei kSize = 32;
    const std::vector<glm::vec2> table = make_split_sum_table(kSize);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, GL_RG32F, kSize, kSize);
    glTextureSubImage2D(name, 0, 0, 0, kSize, kSize, GL_RG, GL_FLOAT, table.data());
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    return GlTexture(name);
}

}  // namespace

Result<ReflectionTextures> ReflectionTextures::make(const ReflectionsView& reflections,
                                                    const glm::dvec3& origin) {
    ReflectionTextures made;
    if (reflections.probes.empty()) return made;
    if (auto status = check_limits(reflections); !status) return status.error();
    std::vector<GlReflectionProbe> probes;
    for (const uint32_t i : reflection_order(reflections)) {
        const ReflectionProbe& probe = reflections.probes[i];
        probes.push_back(
            {make_shader_reflection_probe(probe, i, origin), pack_sh(probe.irradiance)});
    }
    made.cubes_ = make_cubes(reflections);
    made.split_sum_ = make_split_sum();
    made.probes_ = make_gl_buffer(probes);
    made.probe_count_ = static_cast<uint32_t>(probes.size());
    made.level_count_ = reflections.level_count;
    return made;
}

void ReflectionTextures::bind() const {
    if (probe_count_ == 0) return;
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kReflectionProbeBinding, probes_.name());
    glBindTextureUnit(kReflectionUnit, cubes_.name());
    glBindTextureUnit(kSplitSumUnit, split_sum_.name());
}

}  // namespace tetralight
