// SPDX-License-Identifier: Apache-2.0
#include "pipeline/render_scene.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "bake/scene/scene_bounds.h"
#include "probes/interpolate.h"
#include "probes/locate.h"
#include "runtime/shade.h"

namespace tetralight {
namespace {

/// Probe light is looked up this far off a surface, so that a wall takes less of the light behind
/// it.
constexpr float kNormalBias = 0.4f;

/// A ray through more back faces than this is stuck.
constexpr int kMaxCulledFaces = 64;

PackedSh light_at(const ProbeVolumeView& volume, const glm::dvec3& position) {
    const CellLocation location = locate(volume, glm::vec3(position));
    return pack_sh(interpolate(volume, location).irradiance);
}

}  // namespace

SceneShader::SceneShader(const Scene& scene, const ProbeVolumeView& volume, TraceScene traced)
    : scene_(&scene), volume_(volume), traced_(std::move(traced)) {
    light_of_mover_.resize(scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const MeshInstance& instance = scene.instances[i];
        const auto bounds = instance_bounds(scene, instance);
        if (instance.contributes_gi || !bounds) continue;
        light_of_mover_[i] = light_at(volume, bounds->center());
    }
    for (const Light& light : volume.lights) {
        if (light.mode != LightMode::Baked) {
            direct_lights_.push_back(traced_.traced_from_world(light));
        }
    }
}

Result<SceneShader> SceneShader::make(const Scene& scene, const ProbeVolumeView& volume) {
    auto traced = TraceScene::make(scene, [](const MeshInstance&) { return true; });
    if (!traced) return traced.error();
    return SceneShader(scene, volume, std::move(*traced));
}

PackedSh SceneShader::probe_light(const Surface& surface) const {
    if (!scene_->instances[surface.instance].contributes_gi) {
        return light_of_mover_[surface.instance];
    }
    const glm::vec3 position = surface.position + kNormalBias * surface.geometric_normal;
    return light_at(volume_, traced_.world_from_traced(position));
}

glm::vec3 SceneShader::direct_term(const Surface& surface) const {
    const glm::vec3 position = TraceScene::ray_origin(surface, surface.geometric_normal);
    glm::vec3 sum(0.0f);
    for (const Light& light : direct_lights_) {
        const glm::vec3 direct = direct_light(light, surface.position, surface.shading_normal);
        if (direct == glm::vec3(0.0f)) continue;
        const Illumination arriving = illuminate(light, surface.position);
        if (!traced_.is_blocked({position, arriving.to_light, arriving.distance})) sum += direct;
    }
    return sum;
}

std::optional<Surface> SceneShader::first_front_face(glm::vec3 origin, glm::vec3 direction) const {
    std::optional<Surface> surface = traced_.cast({origin, direction});
    for (int i = 0; surface && surface->is_back_face && i < kMaxCulledFaces; ++i) {
        const glm::vec3 behind = TraceScene::ray_origin(*surface, -surface->geometric_normal);
        surface = traced_.cast({behind, direction});
    }
    return surface;
}

std::optional<SceneShader::Shaded> SceneShader::shade(const glm::dvec3& origin,
                                                      glm::vec3 direction) const {
    const glm::vec3 traced_origin = traced_.traced_from_world(origin);
    const auto surface = first_front_face(traced_origin, direction);
    if (!surface) return std::nullopt;
    const float distance = glm::distance(traced_origin, surface->position);
    const glm::vec3 reflected = shade_diffuse(surface->albedo, probe_light(*surface),
                                              surface->shading_normal, direct_term(*surface));
    return Shaded{surface->emission + reflected, distance};
}

std::optional<float> SceneShader::distance(const glm::dvec3& origin, glm::vec3 direction) const {
    const glm::vec3 traced_origin = traced_.traced_from_world(origin);
    const auto surface = first_front_face(traced_origin, direction);
    if (!surface) return std::nullopt;
    return glm::distance(traced_origin, surface->position);
}

bool SceneShader::is_blocked(const glm::dvec3& origin, glm::vec3 direction, float distance) const {
    return traced_.is_blocked({traced_.traced_from_world(origin), direction, distance});
}

glm::vec3 sky_radiance(const ProbeVolumeView& volume, glm::vec3 direction) {
    return glm::max(evaluate_radiance(radiance_from_irradiance(volume.info.ambient), direction),
                    glm::vec3(0.0f));
}

Result<ImageF> render_scene(const Scene& scene, const ProbeVolumeView& volume, const Camera& camera,
                            const RenderSettings& settings) {
    const auto shader = SceneShader::make(scene, volume);
    if (!shader) return shader.error();
    return render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
        const auto shaded = shader->shade(origin, direction);
        return shaded ? shaded->radiance : sky_radiance(volume, direction);
    });
}

}  // namespace tetralight
