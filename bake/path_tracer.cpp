// SPDX-License-Identifier: Apache-2.0
#include "bake/path_tracer.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "bake/scene/environment.h"

namespace tetralight {

PathTracer::PathTracer(const Scene& scene, const TraceScene& traced, uint32_t bounces)
    : scene_(scene), traced_(traced), bounces_(bounces) {
    for (const Light& light : scene.lights) lights_.push_back(traced.traced_from_world(light));
}

PathSample PathTracer::trace(glm::vec3 origin, glm::vec3 direction, RandomStream random) const {
    PathSample sample;
    glm::vec3 throughput(1.0f);
    Ray ray{origin, direction};
    for (uint32_t bounce = 0;; ++bounce) {
        ++sample.ray_count;
        const std::optional<Surface> surface = traced_.cast(ray);
        if (!surface) {
            sample.radiance += throughput * environment_radiance(scene_.environment, ray.direction);
            return sample;
        }
        if (surface->is_back_face) {
            sample.is_behind_surface = bounce == 0;
            return sample;
        }
        sample.radiance += throughput * surface->emission;
        if (bounce == bounces_ || surface->albedo == glm::vec3(0.0f)) return sample;

        const glm::vec3 normal = surface->geometric_normal;
        const glm::vec3 position = traced_.ray_origin(surface->position, normal);
        throughput *= surface->albedo;  // cosine-weighted: albedo/π · cos θ over cos θ/π
        sample.radiance += throughput * reflected_light(*surface, position, sample.ray_count);
        ray = {position, sample_cosine_hemisphere(normal, random.next2())};
    }
}

Illumination PathTracer::visible_light(const Light& traced_light, glm::vec3 position) const {
    Illumination arriving = illuminate(traced_light, position);
    if (arriving.irradiance == glm::vec3(0.0f)) return arriving;
    if (traced_.is_blocked({position, arriving.to_light, arriving.distance})) {
        arriving.irradiance = glm::vec3(0.0f);
    }
    return arriving;
}

glm::vec3 PathTracer::reflected_light(const Surface& surface, glm::vec3 ray_origin,
                                      uint32_t& ray_count) const {
    glm::vec3 irradiance(0.0f);
    for (const Light& light : lights_) {
        const Illumination possible = illuminate(light, surface.position);
        const float cosine = glm::dot(surface.geometric_normal, possible.to_light);
        if (cosine <= 0.0f || possible.irradiance == glm::vec3(0.0f)) continue;
        ++ray_count;
        if (traced_.is_blocked({ray_origin, possible.to_light, possible.distance})) continue;
        irradiance += possible.irradiance * cosine;
    }
    return irradiance * std::numbers::inv_pi_v<float>;
}

}  // namespace tetralight
