// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_cubes.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/lightmap_scene.h>

namespace tetralight {
namespace {

/// Lights whose direct light is not in lightmaps of this mixed lighting.
Result<std::vector<Light>> lights_beside(const Scene& scene, MixedLighting mixed_lighting) {
    std::vector<Light> lights;
    if (mixed_lighting == MixedLighting::Subtractive) return lights;
    const auto plan = plan_lighting(scene, {mixed_lighting, {}});
    if (!plan) return plan.error();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (plan->bake.mode_of(scene, i) == LightMode::Mixed) lights.push_back(scene.lights[i]);
    }
    return lights;
}

}  // namespace

Result<LightmapCubes> LightmapCubes::make(const Scene& scene, const PathCubes& paths,
                                          const LightmapsView& lightmaps) {
    if (auto status = check_lightmap_scene(lightmaps, scene); !status) return status.error();
    const bool is_relit = std::ranges::any_of(
        lightmaps.layers, [](const LightmapLayer& layer) { return layer.weight != 1.0f; });
    if (is_relit) {
        return Error{ErrorCode::InvalidArgument, "lightmaps", "",
                     "the lightmaps were relit; reflections need their light as it was baked"};
    }
    auto lights = lights_beside(scene, lightmaps.info.mixed_lighting);
    if (!lights) return lights.error();
    for (Light& light : *lights) light = paths.trace_scene().render_from_world(light);
    return LightmapCubes(scene, paths, lightmaps, std::move(*lights));
}

CubeSample LightmapCubes::sample(const glm::dvec3& position, glm::vec3 direction, float spread,
                                 const Sampler& sampler) const {
    uint32_t ray_count = 0;
    const auto surface = paths_.first_surface(position, direction, spread, ray_count);
    if (!surface) return {environment_radiance(scene_.environment, direction), false, ray_count};
    if (surface->is_back_face) return {glm::vec3(0.0f), true, ray_count};
    if (!has_lightmap(*surface)) {
        CubeSample path = paths_.sample(position, direction, spread, sampler, {});
        path.ray_count += ray_count;
        return path;
    }
    const TraceScene& traced = paths_.trace_scene();
    const glm::vec2 uv = page_uv_of(lightmaps_, scene_, surface->instance, surface->primitive,
                                    traced.world_from_render(surface->position));
    const uint32_t page = lightmaps_.rectangles[surface->instance].page;
    Sampler light_sampler = sampler;
    const glm::vec3 irradiance = sample_irradiance(lightmaps_, page, uv) +
                                 mixed_irradiance(*surface, light_sampler, ray_count);
    const glm::vec3 reflected = surface->albedo * irradiance * std::numbers::inv_pi_v<float>;
    return {surface->emission + reflected, false, ray_count};
}

bool LightmapCubes::has_lightmap(const Surface& surface) const {
    return !surface.is_from_behind && lightmaps_.rectangles[surface.instance].page != kNoIndex;
}

glm::vec3 LightmapCubes::mixed_irradiance(const Surface& surface, Sampler& sampler,
                                          uint32_t& ray_count) const {
    const TraceScene& traced = paths_.trace_scene();
    const glm::vec3 origin = TraceScene::ray_origin(surface, surface.geometric_normal);
    glm::vec3 irradiance(0.0f);
    for (const Light& light : mixed_lights_) {
        const LightSample sample = sample_light(light, surface.position, sampler.next2());
        const float cosine = glm::dot(surface.geometric_normal, sample.to_light);
        if (cosine <= 0.0f || sample.irradiance == glm::vec3(0.0f)) continue;
        ++ray_count;
        const bool is_shadowed = sample.is_distant
                                     ? traced.occluded({origin, sample.to_light})
                                     : traced.occluded({origin, sample.target - origin, 1.0f});
        if (!is_shadowed) irradiance += cosine * sample.irradiance;
    }
    return irradiance;
}

}  // namespace tetralight
