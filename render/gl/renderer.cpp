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
#include <tetralight/render/gl/detail/clip_space.h>
#include <tetralight/render/gl/detail/frame.h>
#include <tetralight/render/gl/driver.h>
#include <tetralight/runtime/shade.h>

namespace tetralight {
namespace {

/// The volume with its origin in render space.
ShaderVolume moved(ShaderVolume volume, const ProbeVolumeView& view, const glm::dvec3& origin) {
    const glm::dvec3 position = view.info.world_origin - origin;
    const glm::vec3 rounded(position);
    volume.constants.origin = glm::vec4(rounded, volume.constants.origin.w);
    volume.constants.origin_rest = glm::vec4(glm::vec3(position - glm::dvec3(rounded)), 0.0f);
    return volume;
}

std::vector<RuntimeLight> moved(std::vector<RuntimeLight> lights, const glm::dvec3& origin) {
    for (RuntimeLight& runtime : lights) {
        runtime.light.position = glm::vec3(glm::dvec3(runtime.light.position) - origin);
    }
    return lights;
}

/// The ambient probe, scaled so that `sample_sh9` returns the radiance of the sky.
PackedSh packed_sky(const ProbeVolumeView& volume) {
    const RadianceSh radiance = radiance_from_irradiance(volume.info.ambient);
    IrradianceSh scaled;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        scaled.coefficients[i] = radiance.coefficients[i] * std::numbers::pi_v<float>;
    }
    return pack_sh(scaled);
}

/// A sphere around all shadow casters, in render space.
glm::vec4 caster_bounds(const Scene& scene, std::span<const glm::dvec4> spheres,
                        const glm::dvec3& origin) {
    std::vector<WorldBox> boxes;
    if (const auto box = scene_bounds(scene, [](const MeshInstance&) { return true; })) {
        boxes.push_back(*box);
    }
    for (const glm::dvec4& ball : spheres) {
        boxes.push_back({glm::dvec3(ball) - ball.w, glm::dvec3(ball) + ball.w});
    }
    if (boxes.empty()) return {0.0f, 0.0f, 0.0f, 1.0f};
    WorldBox all = boxes[0];
    for (const WorldBox& box : boxes) all = union_of(all, box);
    const double radius = std::max(0.5 * glm::length(all.size()), 1e-3);
    return {glm::vec3(all.center() - origin), static_cast<float>(radius)};
}

/// For each occlusion channel, the visibility of its light. If two lights share a channel, which
/// they only do if they hardly overlap, the one that is brighter at this position counts.
glm::vec4 occlusion_of(const InstanceLight& instance, std::span<const RuntimeLight> lights,
                       glm::vec3 position) {
    glm::vec4 occlusion(1.0f), brightness(-1.0f);
    for (size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].channel >= 4) continue;
        const auto channel = static_cast<int>(lights[i].channel);
        const glm::vec3 irradiance = illuminate(lights[i].light, position).irradiance;
        const float sum = irradiance.x + irradiance.y + irradiance.z;
        if (sum <= brightness[channel]) continue;
        brightness[channel] = sum;
        occlusion[channel] = instance.visibility[i];
    }
    return occlusion;
}

/// Averages blocks of `scale` × `scale` pixels.
ImageF shrunk(const ImageF& image, uint32_t scale) {
    if (scale == 1) return image;
    ImageF result{image.width / scale, image.height / scale, {}};
    const float weight = 1.0f / static_cast<float>(scale * scale);
    for (uint32_t row = 0; row < result.height; ++row) {
        for (uint32_t column = 0; column < result.width; ++column) {
            glm::vec3 sum(0.0f);
            for (uint32_t i = 0; i < scale * scale; ++i) {
                const size_t y = size_t{row} * scale + i / scale;
                sum += image.pixels[y * image.width + column * scale + i % scale];
            }
            result.pixels.push_back(sum * weight);
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
    auto reflections = ReflectionTextures::make(light.reflections, renderer.origin_);
    if (!reflections) return reflections.error();
    renderer.reflections_ = std::move(*reflections);
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
      bounds_(caster_bounds(scene, settings.sphere_bounds, origin_)),
      sky_(packed_sky(volume)),
      volume_(moved(make_shader_volume(volume), volume, origin_)),
      meshes_(scene, light),
      instances_(scene.instances.size()),
      shadows_(moved(light.lights, origin_), light.lightmaps, bounds_, settings.shadow_map_size),
      frame_(make_gl_buffer()) {
    for (const Lppv& lppv : light.proxy_volumes) proxies_.emplace_back(lppv, origin_);
    shadow_color_ = light.shadow_color;
    has_box_projection_ = light.has_box_projection;
    add_instances(scene, light);
    glNamedBufferStorage(frame_.name(), sizeof(detail::Frame), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void Renderer::add_instances(const Scene& scene, const SceneLight& light) {
    std::vector<uint32_t> order(scene.instances.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto is_mirrored = [&](uint32_t i) {
        return glm::determinant(glm::dmat3(scene.instances[i].world_from_mesh)) < 0.0;
    };
    const auto key = [&](uint32_t i) {
        const MeshInstance& instance = scene.instances[i];
        return std::tuple(meshes_.mesh_of(i), light.instances[i].proxy_volume, is_mirrored(i),
                          instance.contributes_gi);
    };
    std::ranges::stable_sort(order, {}, key);
    const std::vector<RuntimeLight> lights = moved(light.lights, origin_);
    const glm::dmat4 space_from_world = glm::translate(glm::dmat4(1.0), -origin_);
    const auto instances = instances_.begin_write();
    for (uint32_t i = 0; i < order.size(); ++i) {
        const MeshInstance& source = scene.instances[order[i]];
        const InstanceLight& lit = light.instances[order[i]];
        const uint32_t mesh = meshes_.mesh_of(order[i]);
        const auto bounds = instance_bounds(scene, source);
        const glm::vec3 center(bounds ? bounds->center() - origin_ : glm::dvec3(0.0));
        GlInstance instance;
        set_transform(instance, space_from_world * source.world_from_mesh);
        instance.factors.w = 1.0f;
        instance.use = lit.use;
        instance.direct = source.contributes_gi ? DirectUse::Still : DirectUse::Moving;
        instance.material = mesh;
        instance.occlusion = occlusion_of(lit, lights, center);
        instance.light = lit.light;
        instances[i] = instance;
        const bool blends =
            meshes_.mesh(mesh).alpha_mode == AlphaMode::Blend;  // drawn back to front
        if (blends || i == 0 || key(order[i]) != key(order[i - 1])) {
            batches_.push_back({mesh, i, 0, lit.proxy_volume, is_mirrored(order[i]),
                                !source.contributes_gi, center});
        }
        ++batches_.back().count;
    }
    lightmaps_ = LightmapTextures(light, !scene.normal_maps.empty(), order);
}

Result<ImageF> Renderer::render(const Camera& camera, const RenderSettings& settings,
                                std::span<const SphereInstances> spheres) {
    const uint32_t scale = pixels_per_axis(settings);
    if (auto status = check_size(settings, scale); !status) return status.error();
    const uint32_t samples = settings.samples_per_axis == 1 ? 1 : 4;
    const RenderTarget target(settings.width * scale, settings.height * scale, samples);
    if (auto status = draw(camera, target, spheres); !status) return status.error();
    const ImageF image = shrunk(target.read(), scale);
    if (auto status = messages_.check(); !status) return status.error();
    return image;
}

Result<DepthImage> Renderer::depth(const Camera& camera, const RenderSettings& settings,
                                   std::span<const SphereInstances> spheres) {
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
    const detail::ClipSpace clip = clip_space(camera, target, spheres);
    draw_depth(clip_from_space(camera, clip), spheres);
    const std::vector<float> depths = target.read_depth();
    if (auto status = messages_.check(); !status) return status.error();
    DepthImage image{settings.width, settings.height, {}};
    for (uint32_t row = 0; row < settings.height; ++row) {
        for (uint32_t column = 0; column < settings.width; ++column) {
            auto& quarters = image.depths.emplace_back();
            for (uint32_t i = 0; i < 4; ++i) {
                const float value = depths[(size_t{2} * row + i / 2) * width + 2 * column + i % 2];
                quarters[i] = value > 0.0f ? static_cast<float>(clip.depth(double{value}))
                                           : std::numeric_limits<float>::infinity();
            }
        }
    }
    return image;
}

}  // namespace tetralight
