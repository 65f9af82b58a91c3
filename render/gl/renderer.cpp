// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/renderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/render/gl/driver.h>
#include <tetralight/runtime/shade.h>

namespace tetralight {
namespace {

/// The uniform block `Frame` (std140).
struct Frame {
    glm::vec4 eye, right, up, ahead;
    glm::uvec4 counts;
    glm::vec4 numbers;
    PackedSh sky;
};

static_assert(sizeof(Frame) == 96 + sizeof(PackedSh));

/// The volume's constants with its origin in the renderer's space.
ShaderVolume moved(ShaderVolume volume, const ProbeVolumeView& view, const glm::dvec3& origin) {
    const glm::dvec3 place = view.info.world_origin - origin;
    const glm::vec3 rounded(place);
    volume.constants.origin = glm::vec4(rounded, volume.constants.origin.w);
    volume.constants.origin_rest = glm::vec4(glm::vec3(place - glm::dvec3(rounded)), 0.0f);
    return volume;
}

std::vector<RuntimeLight> moved(std::vector<RuntimeLight> lights, const glm::dvec3& origin) {
    for (RuntimeLight& runtime : lights) {
        runtime.light.position = glm::vec3(glm::dvec3(runtime.light.position) - origin);
    }
    return lights;
}

/// Such that `sample_sh9` gives the radiance of the sky.
PackedSh packed_sky(const ProbeVolumeView& volume) {
    const RadianceSh radiance = radiance_from_irradiance(volume.info.ambient);
    IrradianceSh scaled;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        scaled.coefficients[i] = radiance.coefficients[i] * std::numbers::pi_v<float>;
    }
    return pack_sh(scaled);
}

/// A sphere around all that casts shadows, in the renderer's space.
glm::vec4 caster_bounds(const Scene& scene, std::span<const glm::dvec4> crowds,
                        const glm::dvec3& origin) {
    std::vector<WorldBox> boxes;
    if (const auto box = scene_bounds(scene, [](const MeshInstance&) { return true; })) {
        boxes.push_back(*box);
    }
    for (const glm::dvec4& ball : crowds) {
        boxes.push_back({glm::dvec3(ball) - ball.w, glm::dvec3(ball) + ball.w});
    }
    if (boxes.empty()) return {0.0f, 0.0f, 0.0f, 1.0f};
    WorldBox all = boxes[0];
    for (const WorldBox& box : boxes) all = union_of(all, box);
    const double radius = std::max(0.5 * glm::length(all.size()), 1e-3);
    return {glm::vec3(all.center() - origin), static_cast<float>(radius)};
}

/// Occlusion that gives each light's visibility by its channel. Where two lights have one channel,
/// the one counts that is brighter there: they hardly overlap.
glm::vec4 occlusion_of(const InstanceLight& instance, std::span<const RuntimeLight> lights,
                       glm::vec3 place) {
    glm::vec4 occlusion(1.0f), brightness(-1.0f);
    for (size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].channel >= 4) continue;
        const auto channel = static_cast<int>(lights[i].channel);
        const glm::vec3 irradiance = illuminate(lights[i].light, place).irradiance;
        const float sum = irradiance.x + irradiance.y + irradiance.z;
        if (sum <= brightness[channel]) continue;
        brightness[channel] = sum;
        occlusion[channel] = instance.visibility[i];
    }
    return occlusion;
}

void set_culling(bool is_on, bool is_mirrored) {
    is_on ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    glFrontFace(is_mirrored ? GL_CW : GL_CCW);
}

/// Averages blocks of `scale` × `scale` pixels.
ImageF shrunk(const ImageF& image, uint32_t scale) {
    if (scale == 1) return image;
    ImageF result{image.width / scale, image.height / scale, {}};
    const float share = 1.0f / static_cast<float>(scale * scale);
    for (uint32_t row = 0; row < result.height; ++row) {
        for (uint32_t column = 0; column < result.width; ++column) {
            glm::vec3 sum(0.0f);
            for (uint32_t i = 0; i < scale * scale; ++i) {
                const size_t y = size_t{row} * scale + i / scale;
                sum += image.pixels[y * image.width + column * scale + i % scale];
            }
            result.pixels.push_back(sum * share);
        }
    }
    return result;
}

}  // namespace

Result<Renderer> Renderer::make(const Scene& scene, const ProbeVolumeView& volume,
                                const SceneLight& light, const RendererSettings& settings) {
    DebugMessages messages;
    auto shaders = make_renderer_shaders();
    if (!shaders) return shaders.error();
    Renderer renderer(scene, volume, light, settings, std::move(*shaders), std::move(messages));
    if (auto status = renderer.messages_.check(); !status) return status.error();
    return renderer;
}

Renderer::Renderer(const Scene& scene, const ProbeVolumeView& volume, const SceneLight& light,
                   const RendererSettings& settings, RendererShaders shaders,
                   DebugMessages messages)
    : messages_(std::move(messages)),
      shaders_(std::move(shaders)),
      origin_(scene.instances.empty()
                  ? volume.info.world_origin
                  : scene_center(scene, [](const MeshInstance&) { return true; })),
      sky_(packed_sky(volume)),
      volume_(moved(make_shader_volume(volume), volume, origin_)),
      meshes_(scene, light.emission_weights),
      instances_(scene.instances.size()),
      shadows_(moved(light.lights, origin_), caster_bounds(scene, settings.crowd_bounds, origin_),
               settings.shadow_map_size),
      frame_(make_gl_buffer()) {
    near_ = 1e-5f * caster_bounds(scene, settings.crowd_bounds, origin_).w;
    for (const Lppv& lppv : light.proxy_volumes) proxies_.emplace_back(lppv, origin_);
    add_instances(scene, light);
    glNamedBufferStorage(frame_.name(), sizeof(Frame), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void Renderer::add_instances(const Scene& scene, const SceneLight& light) {
    std::vector<uint32_t> order(scene.instances.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto is_mirrored = [&](uint32_t i) {
        return glm::determinant(glm::dmat3(scene.instances[i].world_from_mesh)) < 0.0;
    };
    const auto key = [&](uint32_t i) {
        const MeshInstance& instance = scene.instances[i];
        return std::tuple(instance.mesh, light.instances[i].proxy_volume, is_mirrored(i),
                          instance.contributes_gi);
    };
    std::ranges::stable_sort(order, {}, key);
    const std::vector<RuntimeLight> lights = moved(light.lights, origin_);
    const glm::dmat4 space_from_world = glm::translate(glm::dmat4(1.0), -origin_);
    const auto instances = instances_.begin_write();
    for (uint32_t i = 0; i < order.size(); ++i) {
        const MeshInstance& source = scene.instances[order[i]];
        const InstanceLight& lit = light.instances[order[i]];
        const auto bounds = instance_bounds(scene, source);
        const glm::vec3 middle(bounds ? bounds->center() - origin_ : glm::dvec3(0.0));
        GlInstance instance;
        set_transform(instance, space_from_world * source.world_from_mesh);
        instance.use = lit.use;
        instance.direct = source.contributes_gi ? DirectUse::Still : DirectUse::Moving;
        instance.material = source.mesh;
        instance.occlusion = occlusion_of(lit, lights, middle);
        instance.light = lit.light;
        instances[i] = instance;
        const bool blends =
            meshes_.mesh(source.mesh).alpha_mode == AlphaMode::Blend;  // drawn back to front
        if (blends || i == 0 || key(order[i]) != key(order[i - 1])) {
            batches_.push_back({source.mesh, i, 0, lit.proxy_volume, is_mirrored(order[i]),
                                !source.contributes_gi, middle});
        }
        ++batches_.back().count;
    }
}

glm::mat4 Renderer::clip_from_space(const Camera& camera, const RenderTarget& target) const {
    const double height = std::tan(0.5 * camera.fov_y_radians);
    const double width = height * target.width() / target.height();
    glm::dmat4 view(1.0);  // rows: right, up, back
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 axis(camera.world_from_camera[i]);
        for (int j = 0; j < 3; ++j) view[j][i] = axis[j];
    }
    view = glm::translate(view, origin_ - glm::dvec3(camera.world_from_camera[3]));
    // Depth is near / distance: 1 at the near plane, 0 at infinity, even in precision.
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / width;
    clip[1][1] = 1.0 / height;
    clip[2][3] = -1.0;
    clip[3][2] = near_;
    return glm::mat4(clip * view);
}

void Renderer::write_frame(const Camera& camera, const RenderTarget& target) {
    const double height = std::tan(0.5 * camera.fov_y_radians);
    const double width = height * target.width() / target.height();
    Frame frame{};
    frame.eye = glm::vec4(glm::vec3(glm::dvec3(camera.world_from_camera[3]) - origin_), 1.0f);
    frame.right = glm::vec4(camera.world_from_camera[0] * width);
    frame.up = glm::vec4(camera.world_from_camera[1] * height);
    frame.ahead = glm::vec4(-camera.world_from_camera[2]);
    frame.counts.x = shadows_.light_count();
    frame.numbers.x = kProbeNormalBias;
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

void Renderer::draw_crowd(const SphereInstances& crowd, Pass pass) {
    if (crowd.count == 0) return;
    const GlMesh& mesh = meshes_.mesh(meshes_.sphere(crowd.subdivisions));
    if (pass == Pass::Lit && crowd.proxy_volume != kNoIndex) {
        proxies_[crowd.proxy_volume].bind(kProxyBinding, kProxyLightUnit, kProxyOcclusionUnit);
    }
    const auto* offset = reinterpret_cast<const void*>(size_t{mesh.first_index} * 4);
    glUniform1ui(kFirstInstance, 0);
    for (size_t first = 0; first < crowd.count; first += crowd.instances->range_size()) {
        const size_t count = std::min(crowd.instances->range_size(), crowd.count - first);
        crowd.instances->bind(kInstanceBinding, first, count);
        glDrawElementsInstancedBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(mesh.index_count),
                                          GL_UNSIGNED_INT, offset, static_cast<GLsizei>(count),
                                          mesh.first_vertex);
    }
}

void Renderer::draw_shadows(std::span<const SphereInstances> crowds) {
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
            for (const SphereInstances& crowd : crowds) {
                if (is_opaque && crowd.casts_shadows == CastsShadows::Yes)
                    draw_crowd(crowd, Pass::Depth);
            }
        }
    });
    glDisable(GL_DEPTH_CLAMP);
}

void Renderer::draw_depth(const glm::mat4& matrix, std::span<const SphereInstances> crowds) {
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const bool is_masked : {false, true}) {
        const ShaderProgram& program = is_masked ? shaders_.masked_depth : shaders_.depth;
        glProgramUniformMatrix4fv(program.name(), kClipFromSpace, 1, GL_FALSE, &matrix[0][0]);
        glUseProgram(program.name());
        if (is_masked) {  // holes are cut sample by sample
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
        for (const SphereInstances& crowd : crowds) draw_crowd(crowd, Pass::Depth);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void Renderer::draw_surfaces(std::span<const SphereInstances> crowds) {
    glDepthFunc(GL_EQUAL);
    glDepthMask(GL_FALSE);
    for (const Batch& batch : batches_) {
        const GlMesh& mesh = meshes_.mesh(batch.mesh);
        if (mesh.alpha_mode == AlphaMode::Blend) continue;
        set_culling(!mesh.is_double_sided, batch.is_mirrored);
        draw_batch(batch, Pass::Lit);
    }
    set_culling(true, false);
    for (const SphereInstances& crowd : crowds) draw_crowd(crowd, Pass::Lit);
}

void Renderer::draw_blended(const glm::vec3& eye) {
    std::vector<const Batch*> blended;
    for (const Batch& batch : batches_) {
        if (meshes_.mesh(batch.mesh).alpha_mode == AlphaMode::Blend) blended.push_back(&batch);
    }
    std::ranges::sort(blended, std::greater{},
                      [&](const Batch* batch) { return glm::distance(batch->middle, eye); });
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
                      std::span<const SphereInstances> crowds) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glDisable(GL_BLEND);
    meshes_.bind(kMaterialBinding);
    draw_shadows(crowds);

    target.bind();
    glClearDepth(0.0);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const glm::mat4 matrix = clip_from_space(camera, target);
    draw_depth(matrix, crowds);

    write_frame(camera, target);
    volume_.bind();
    shadows_.bind(kLightBinding, kLayerBinding, kShadowUnit);
    glUseProgram(shaders_.lit.name());
    glUniformMatrix4fv(kClipFromSpace, 1, GL_FALSE, &matrix[0][0]);
    draw_surfaces(crowds);
    glUseProgram(shaders_.sky.name());
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, 3);  // EQUAL: where depth is still 0
    glUseProgram(shaders_.lit.name());
    draw_blended(glm::vec3(glm::dvec3(camera.world_from_camera[3]) - origin_));
    target.resolve();
    instances_.end_draw();
    for (const SphereInstances& crowd : crowds) crowd.instances->end_draw();
    return messages_.check();
}

Result<ImageF> Renderer::render(const Camera& camera, const RenderSettings& settings,
                                std::span<const SphereInstances> crowds) {
    const uint32_t scale = pixels_per_axis(settings);
    if (auto status = check_size(settings, scale); !status) return status.error();
    const uint32_t samples = settings.samples_per_axis == 1 ? 1 : 4;
    const RenderTarget target(settings.width * scale, settings.height * scale, samples);
    if (auto status = draw(camera, target, crowds); !status) return status.error();
    const ImageF image = shrunk(target.read(), scale);
    if (auto status = messages_.check(); !status) return status.error();
    return image;
}

Result<DepthImage> Renderer::depth(const Camera& camera, const RenderSettings& settings,
                                   std::span<const SphereInstances> crowds) {
    if (auto status = check_size(settings, 2); !status) return status.error();
    const uint32_t width = 2 * settings.width;
    const RenderTarget target(width, 2 * settings.height, 1);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    meshes_.bind(kMaterialBinding);
    target.bind();
    glClearDepth(0.0);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_depth(clip_from_space(camera, target), crowds);
    const std::vector<float> depths = target.read_depth();
    if (auto status = messages_.check(); !status) return status.error();
    DepthImage image{settings.width, settings.height, {}};
    for (uint32_t row = 0; row < settings.height; ++row) {
        for (uint32_t column = 0; column < settings.width; ++column) {
            auto& quarters = image.depths.emplace_back();
            for (uint32_t i = 0; i < 4; ++i) {
                const float value = depths[(size_t{2} * row + i / 2) * width + 2 * column + i % 2];
                quarters[i] = value > 0.0f ? near_ / value : std::numeric_limits<float>::infinity();
            }
        }
    }
    return image;
}

}  // namespace tetralight
