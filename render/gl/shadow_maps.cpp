// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/shadow_maps.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace tetralight {
namespace {

/// Lights that need more layers than this cast no shadows: limits the memory of shadow maps.
constexpr size_t kMaxLayers = 48;

/// Clip from render space of a directional light; depth from 0 (near) to 1 (far).
glm::mat4 sun_matrix(glm::vec3 direction, glm::vec4 bounds) {
    const glm::vec3 center(bounds);
    const glm::vec3 up = std::abs(direction.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::mat4 view = glm::lookAtRH(center - direction * bounds.w, center, up);
    return glm::orthoRH_ZO(-bounds.w, bounds.w, -bounds.w, bounds.w, 0.0f, 2.0f * bounds.w) * view;
}

/// Face i of a cube around a light: +x, -x, +y, -y, +z, -z.
glm::mat4 face_matrix(glm::vec3 position, int face, float reach) {
    glm::vec3 direction(0.0f), up(0.0f);
    direction[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
    up[(face / 2 + 1) % 3] = 1.0f;
    const glm::mat4 view = glm::lookAtRH(position, position + direction, up);
    return glm::perspectiveRH_ZO(glm::half_pi<float>(), 1.0f, 1e-3f * reach, reach) * view;
}

GlLight make_light(const RuntimeLight& runtime, const LightmapsView& lightmaps) {
    const Light& light = runtime.light;
    GlLight result;
    result.position = glm::vec4(light.position, light.range);
    result.direction = glm::vec4(light.direction, static_cast<float>(light.type));
    result.intensity = glm::vec4(light.intensity, static_cast<float>(light.falloff));
    result.shape = {light.cos_inner_cone, light.cos_outer_cone, light_area(light), 0.0f};
    result.shadow.w = runtime.channel == kNoIndex ? -1 : static_cast<int>(runtime.channel);
    result.reach.x = runtime.lights_moving ? 1 : 0;
    result.reach.y = static_cast<int>(lightmap_shadow(lightmaps, runtime));
    return result;
}

}  // namespace

ShadowMaps::ShadowMaps(std::span<const RuntimeLight> lights, const LightmapsView& lightmaps,
                       glm::vec4 bounds, uint32_t size)
    : light_count_(static_cast<uint32_t>(lights.size())), size_(size) {
    std::vector<GlLight> gl_lights;
    std::vector<GlShadowLayer> gl_layers;
    for (const RuntimeLight& runtime : lights) {
        GlLight& light = gl_lights.emplace_back(make_light(runtime, lightmaps));
        const bool is_sun = runtime.light.type == LightType::Directional;
        const int layer_count = is_sun ? 1 : 6;
        const bool has_moving = runtime.channel != kNoIndex;
        const size_t needed = static_cast<size_t>(layer_count) * (has_moving ? 2 : 1);
        if (layers_.size() + needed > kMaxLayers) continue;
        light.shadow.z = layer_count;
        const float reach =
            1.01f * (glm::distance(runtime.light.position, glm::vec3(bounds)) + bounds.w);
        for (const auto casters : {ShadowCasters::All, ShadowCasters::Moving}) {
            if (casters == ShadowCasters::Moving && !has_moving) continue;
            light.shadow[casters == ShadowCasters::All ? 0 : 1] = static_cast<int>(layers_.size());
            for (int face = 0; face < layer_count; ++face) {
                const glm::mat4 matrix = is_sun ? sun_matrix(runtime.light.direction, bounds)
                                                : face_matrix(runtime.light.position, face, reach);
                layers_.push_back({matrix, casters});
                const float texel = 2.0f * (is_sun ? bounds.w : 1.0f) / static_cast<float>(size);
                gl_layers.push_back({matrix, {texel, is_sun ? 0.0f : 1.0f, 0.0f, 0.0f}});
            }
        }
    }
    lights_ = make_gl_buffer(gl_lights);
    gl_layers_ = make_gl_buffer(gl_layers);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    maps_ = GlTexture(name);
    const auto side = static_cast<GLsizei>(layers_.empty() ? 1 : size);
    glTextureStorage3D(name, 1, GL_DEPTH_COMPONENT32F, side, side,
                       static_cast<GLsizei>(std::max<size_t>(layers_.size(), 1)));
    glTextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, &name);
    frame_ = GlFramebuffer(name);
    glNamedFramebufferDrawBuffer(name, GL_NONE);
}

void ShadowMaps::draw(const std::function<void(const glm::mat4&, ShadowCasters)>& draw) const {
    const auto side = static_cast<GLsizei>(size_);
    glViewport(0, 0, side, side);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glClearDepth(1.0);
    glDisable(GL_CULL_FACE);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.name());
    for (size_t i = 0; i < layers_.size(); ++i) {
        glNamedFramebufferTextureLayer(frame_.name(), GL_DEPTH_ATTACHMENT, maps_.name(), 0,
                                       static_cast<GLint>(i));
        glClear(GL_DEPTH_BUFFER_BIT);
        draw(layers_[i].clip_from_space, layers_[i].casters);
    }
}

void ShadowMaps::bind(GLuint light_binding, GLuint layer_binding, GLuint unit) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, light_binding, lights_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, layer_binding, gl_layers_.name());
    glBindTextureUnit(unit, maps_.name());
}

}  // namespace tetralight
