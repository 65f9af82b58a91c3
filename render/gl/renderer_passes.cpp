// SPDX-License-Identifier: Apache-2.0
// The passes of a frame: shadow maps, depth, surfaces, sky, blended surfaces.
#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include <tetralight/render/gl/detail/clip_space.h>
#include <tetralight/render/gl/detail/frame.h>
#include <tetralight/render/gl/renderer.h>

namespace tetralight {
namespace {

void set_culling(bool is_on, bool is_mirrored) {
    is_on ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    glFrontFace(is_mirrored ? GL_CW : GL_CCW);
}

}  // namespace

detail::ClipSpace Renderer::clip_space(const Camera& camera, const RenderTarget& target,
                                       std::span<const SphereInstances> spheres) const {
    const double near = 1e-5 * double{bounds_.w};
    double far = std::numeric_limits<double>::infinity();
    if (camera.half_height) {
        // Surfaces at the far plane itself are not drawn.
        const auto end = [&](const glm::dvec4& sphere) {
            return view_distance(camera, glm::dvec3(sphere)) + 1.01 * sphere.w;
        };
        far = std::max(double{bounds_.w}, end(glm::dvec4(origin_, 0.0) + glm::dvec4(bounds_)));
        for (const SphereInstances& group : spheres) {
            if (group.bounds) far = std::max(far, end(*group.bounds));
        }
    }
    return {camera, static_cast<double>(target.width()) / target.height(), near, far};
}

glm::mat4 Renderer::clip_from_space(const Camera& camera, const detail::ClipSpace& clip) const {
    glm::dmat4 view(1.0);  // rows: right, up, back
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 axis(camera.world_from_camera[i]);
        for (int j = 0; j < 3; ++j) view[j][i] = axis[j];
    }
    view = glm::translate(view, origin_ - glm::dvec3(camera.world_from_camera[3]));
    return glm::mat4(clip.clip_from_view() * view);
}

void Renderer::write_frame(const Camera& camera, const RenderTarget& target) {
    const double height = 0.5 * picture_height(camera).per_metre;
    const double width = height * target.width() / target.height();
    detail::Frame frame{};
    frame.eye = camera.half_height
                    ? glm::vec4(camera.world_from_camera[2])
                    : glm::vec4(camera.world_from_camera[3] - glm::dvec4(origin_, 0.0));
    frame.right = glm::vec4(camera.world_from_camera[0] * width);
    frame.up = glm::vec4(camera.world_from_camera[1] * height);
    frame.ahead = glm::vec4(-camera.world_from_camera[2]);
    frame.counts = {shadows_.light_count(), reflections_.probe_count(), has_box_projection_ ? 1 : 0,
                    std::max(reflections_.level_count(), 1u) - 1};
    frame.shadow_color = glm::vec4(shadow_color_, 0.0f);
    frame.sky = sky_;
    glNamedBufferSubData(frame_.name(), 0, sizeof frame, &frame);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_.name());
}

void Renderer::draw_batch(const Batch& batch, Pass pass) {
    const GlMesh& mesh = meshes_.mesh(batch.mesh);
    for (GLuint unit = 0; unit < mesh.textures.size(); ++unit) {
        glBindTextureUnit(unit, mesh.textures[unit]);
    }
    if (pass == Pass::Lit || pass == Pass::Blended) {
        glBindTextureUnit(kNormalUnit, mesh.normal_map);
        if (batch.proxy_volume != kNoIndex) {
            proxies_[batch.proxy_volume].bind(kProxyBinding, kProxyLightUnit, kProxyOcclusionUnit);
        }
    }
    instances_.bind(kInstanceBinding, 0, std::max<size_t>(instances_.size(), 1));
    glUniform1ui(kFirstInstance, batch.first);
    const auto* offset = reinterpret_cast<const void*>(size_t{mesh.first_index} * 4);
    glDrawElementsInstancedBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(mesh.index_count),
                                      GL_UNSIGNED_INT, offset, static_cast<GLsizei>(batch.count),
                                      mesh.first_vertex);
}

void Renderer::draw_spheres(const SphereInstances& group, Pass pass) {
    if (group.count == 0) return;
    const GlMesh& mesh = meshes_.mesh(meshes_.sphere(group.subdivisions));
    if (pass == Pass::Lit && group.proxy_volume != kNoIndex) {
        proxies_[group.proxy_volume].bind(kProxyBinding, kProxyLightUnit, kProxyOcclusionUnit);
    }
    const auto* offset = reinterpret_cast<const void*>(size_t{mesh.first_index} * 4);
    glUniform1ui(kFirstInstance, 0);
    for (size_t first = 0; first < group.count; first += group.instances->range_size()) {
        const size_t count = std::min(group.instances->range_size(), group.count - first);
        group.instances->bind(kInstanceBinding, first, count);
        glDrawElementsInstancedBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(mesh.index_count),
                                          GL_UNSIGNED_INT, offset, static_cast<GLsizei>(count),
                                          mesh.first_vertex);
    }
}

void Renderer::draw_shadows(std::span<const SphereInstances> spheres) {
    glEnable(GL_DEPTH_CLAMP);
    shadows_.draw([&](const glm::mat4& matrix, ShadowCasters casters) {
        for (const bool is_opaque : {true, false}) {
            glUseProgram((is_opaque ? shaders_.depth : shaders_.masked_depth).name());
            glUniformMatrix4fv(kClipFromSpace, 1, GL_FALSE, &matrix[0][0]);
            for (const Batch& batch : batches_) {
                if (casters == ShadowCasters::Moving && !batch.moves) continue;
                if ((meshes_.mesh(batch.mesh).alpha_mode == AlphaMode::Opaque) != is_opaque) {
                    continue;
                }
                draw_batch(batch, Pass::Depth);
            }
            for (const SphereInstances& group : spheres) {
                if (is_opaque && group.casts_shadows == CastsShadows::Yes)
                    draw_spheres(group, Pass::Depth);
            }
        }
    });
    glDisable(GL_DEPTH_CLAMP);
}

void Renderer::draw_depth(const glm::mat4& matrix, std::span<const SphereInstances> spheres) {
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const bool is_masked : {false, true}) {
        const ShaderProgram& program = is_masked ? shaders_.masked_depth : shaders_.depth;
        glProgramUniformMatrix4fv(program.name(), kClipFromSpace, 1, GL_FALSE, &matrix[0][0]);
        glUseProgram(program.name());
        if (is_masked) {  // alpha is tested for each sample
            glEnable(GL_SAMPLE_SHADING);
            glMinSampleShading(1.0f);
        }
        const AlphaMode wanted = is_masked ? AlphaMode::Mask : AlphaMode::Opaque;
        for (const Batch& batch : batches_) {
            const GlMesh& mesh = meshes_.mesh(batch.mesh);
            if (mesh.alpha_mode != wanted) continue;
            set_culling(!mesh.is_double_sided, batch.is_mirrored);
            draw_batch(batch, Pass::Depth);
        }
        glDisable(GL_SAMPLE_SHADING);
        if (is_masked) continue;
        set_culling(true, false);
        for (const SphereInstances& group : spheres) draw_spheres(group, Pass::Depth);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void Renderer::draw_surfaces(std::span<const SphereInstances> spheres) {
    glDepthFunc(GL_EQUAL);
    glDepthMask(GL_FALSE);
    for (const Batch& batch : batches_) {
        const GlMesh& mesh = meshes_.mesh(batch.mesh);
        if (mesh.alpha_mode == AlphaMode::Blend) continue;
        set_culling(!mesh.is_double_sided, batch.is_mirrored);
        draw_batch(batch, Pass::Lit);
    }
    set_culling(true, false);
    for (const SphereInstances& group : spheres) draw_spheres(group, Pass::Lit);
}

void Renderer::draw_blended(const Camera& camera) {
    std::vector<const Batch*> blended;
    for (const Batch& batch : batches_) {
        if (meshes_.mesh(batch.mesh).alpha_mode == AlphaMode::Blend) blended.push_back(&batch);
    }
    std::ranges::sort(blended, std::greater{}, [&](const Batch* batch) {
        return view_distance(camera, origin_ + glm::dvec3(batch->center));
    });
    glDepthFunc(GL_GREATER);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
    for (const Batch* batch : blended) {
        set_culling(!meshes_.mesh(batch->mesh).is_double_sided, batch->is_mirrored);
        draw_batch(*batch, Pass::Blended);
    }
    glDisable(GL_BLEND);
}

Status Renderer::draw(const Camera& camera, const RenderTarget& target,
                      std::span<const SphereInstances> spheres) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glDisable(GL_BLEND);
    meshes_.bind(kMaterialBinding);
    draw_shadows(spheres);

    target.bind();
    glClearDepth(0.0);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const glm::mat4 matrix = clip_from_space(camera, clip_space(camera, target, spheres));
    draw_depth(matrix, spheres);

    write_frame(camera, target);
    volume_.bind();
    shadows_.bind(kLightBinding, kLayerBinding, kShadowUnit);
    lightmaps_.bind();
    reflections_.bind();
    glUseProgram(shaders_.lit.name());
    glUniformMatrix4fv(kClipFromSpace, 1, GL_FALSE, &matrix[0][0]);
    draw_surfaces(spheres);
    glUseProgram(shaders_.sky.name());
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, 3);  // the depth test EQUAL passes where depth is still 0
    glUseProgram(shaders_.lit.name());
    draw_blended(camera);
    target.resolve();
    instances_.end_draw();
    for (const SphereInstances& group : spheres) group.instances->end_draw();
    return messages_.check();
}

}  // namespace tetralight
