// SPDX-License-Identifier: Apache-2.0
#include "pipeline/render_scene.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "bake/scene/scene_bounds.h"
#include "pipeline/lppv_object.h"
#include "probes/interpolate.h"
#include "probes/locate.h"
#include "probes/recombine.h"
#include "runtime/shade.h"

namespace tetralight {
namespace {

/// Probe light is looked up this far off a surface, so that a wall takes less of the light behind
/// it.
constexpr float kNormalBias = 0.4f;

/// Grid points a metre of a proxy volume.
constexpr double kProxyDensity = 3.0;

/// A ray through more back faces than this is stuck.
constexpr int kMaxCulledFaces = 64;

PackedSh light_at(const ProbeVolumeView& volume, const glm::dvec3& position) {
    const CellLocation location = locate(volume, glm::vec3(position));
    return pack_sh(interpolate(volume, location).irradiance);
}

}  // namespace

SceneShader::SceneShader(const Scene& scene, const ProbeVolumeView& volume, TraceScene traced,
                         TraceScene moving)
    : scene_(&scene), volume_(volume), traced_(std::move(traced)), moving_(std::move(moving)) {
    for (RuntimeLight& light : runtime_lights(volume)) {
        direct_lights_.push_back({std::move(light), {}});
    }
    light_movers();
    for (DirectLight& direct : direct_lights_) {
        direct.light.light = traced_.traced_from_world(direct.light.light);
    }
    find_emission_weights();
}

void SceneShader::light_movers() {
    const size_t count = scene_->instances.size();
    light_of_mover_.resize(count);
    proxy_of_mover_.assign(count, kNoIndex);
    for (DirectLight& direct : direct_lights_) direct.visibility_of_mover.assign(count, 1.0f);
    for (size_t i = 0; i < count; ++i) {
        const MeshInstance& instance = scene_->instances[i];
        const auto bounds = instance_bounds(*scene_, instance);
        if (instance.contributes_gi || !bounds) continue;
        const CellLocation location = locate(volume_, glm::vec3(bounds->center()));
        light_of_mover_[i] = pack_sh(interpolate(volume_, location).irradiance);
        for (DirectLight& direct : direct_lights_) {
            direct.visibility_of_mover[i] = interpolate_visibility(volume_, location, direct.light);
        }
    }
}

/// What the bake did not see shines as it does.
void SceneShader::find_emission_weights() {
    emission_weights_.assign(scene_->materials.size(), 1.0f);
    if (volume_.layers.empty()) return;
    const auto weight_of = [&](uint32_t layer) {
        return layer < volume_.layers.size() ? volume_.layers[layer].weight : 1.0f;
    };
    for (size_t i = 0; i < scene_->materials.size(); ++i) {
        const Material& material = scene_->materials[i];
        if (!material.bakes_emission) continue;
        uint32_t layer = find_layer(volume_, "material:" + material.name);
        if (layer == kNoIndex) layer = find_layer(volume_, "emission");
        if (layer == kNoIndex) layer = find_layer(volume_, "rest");
        emission_weights_[i] = weight_of(layer);
    }
}

Result<SceneShader> SceneShader::make(const Scene& scene, const ProbeVolumeView& volume,
                                      MoverLight movers) {
    auto traced = TraceScene::make(scene, [](const MeshInstance&) { return true; });
    if (!traced) return traced.error();
    auto moving = TraceScene::make(
        scene, [](const MeshInstance& instance) { return !instance.contributes_gi; });
    if (!moving) return moving.error();
    SceneShader shader(scene, volume, std::move(*traced), std::move(*moving));
    if (movers == MoverLight::AsTheScene) {
        if (auto status = shader.add_proxy_volumes(); !status) return status.error();
    }
    return shader;
}

Status SceneShader::add_proxy_volumes() {
    for (const SceneObject& object : find_proxy_objects(*scene_)) {
        LppvSettings settings;
        settings.density = kProxyDensity;
        const auto grid = make_lppv_grid(object.view(), settings);
        if (!grid) return grid.error();
        auto lppv = make_lppv(volume_, *grid, {});
        if (!lppv) return lppv.error();
        for (const uint32_t instance : object.instances) {
            proxy_of_mover_[instance] = static_cast<uint32_t>(proxy_volumes_.size());
        }
        proxy_volumes_.push_back(std::move(*lppv));
    }
    return Ok{};
}

PackedSh SceneShader::probe_light(const Surface& surface) const {
    if (!scene_->instances[surface.instance].contributes_gi) {
        const uint32_t proxy = proxy_of_mover_[surface.instance];
        if (proxy == kNoIndex) return light_of_mover_[surface.instance];
        const glm::vec3 world(traced_.world_from_traced(surface.position));
        return pack_sh(sample_lppv(proxy_volumes_[proxy], world).irradiance);
    }
    const glm::vec3 position = surface.position + kNormalBias * surface.geometric_normal;
    return light_at(volume_, traced_.world_from_traced(position));
}

glm::vec3 SceneShader::direct_term(const Surface& surface) const {
    const bool moves = !scene_->instances[surface.instance].contributes_gi;
    const glm::vec3 origin = TraceScene::ray_origin(surface, surface.geometric_normal);
    const glm::dvec3 world_origin = traced_.world_from_traced(origin);
    glm::vec3 sum(0.0f);
    for (const auto& [runtime, visibility_of_mover] : direct_lights_) {
        if (moves && !runtime.lights_moving) continue;
        glm::vec3 direct = direct_light(runtime.light, surface.position, surface.shading_normal);
        const bool has_static_shadow = moves && runtime.channel != kNoIndex;
        if (has_static_shadow) direct *= visibility_of_mover[surface.instance];
        if (direct == glm::vec3(0.0f)) continue;
        const Illumination arriving = illuminate(runtime.light, surface.position);
        const bool is_shadowed = is_blocked(world_origin, arriving.to_light, arriving.distance,
                                            has_static_shadow ? Casters::Moving : Casters::All);
        if (!is_shadowed) sum += direct;
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
    const uint32_t material = scene_->meshes[scene_->instances[surface->instance].mesh].material;
    return Shaded{surface->emission * emission_weights_[material] + reflected, distance};
}

std::optional<float> SceneShader::distance(const glm::dvec3& origin, glm::vec3 direction) const {
    const glm::vec3 traced_origin = traced_.traced_from_world(origin);
    const auto surface = first_front_face(traced_origin, direction);
    if (!surface) return std::nullopt;
    return glm::distance(traced_origin, surface->position);
}

bool SceneShader::is_blocked(const glm::dvec3& origin, glm::vec3 direction, float distance,
                             Casters who) const {
    const TraceScene& traced = casters(who);
    return traced.is_blocked({traced.traced_from_world(origin), direction, distance});
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
