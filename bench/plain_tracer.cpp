// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/plain_tracer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

}  // namespace

PlainTracer::PlainTracer(const Scene& scene, const TraceScene& traced)
    : scene_(scene), traced_(traced) {
    for (const Light& light : scene.lights) lights_.push_back(traced.render_from_world(light));
    for (const MeshInstance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Material& material = scene.materials[mesh.material];
        if (emission_source(material).factor == glm::vec3(0.0f)) continue;
        if (!instance.contributes_gi || !material.bakes_emission) continue;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Triangle triangle;
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3& p = mesh.positions[mesh.indices[i + k]];
                triangle[k] = traced.render_from_world(world_position(instance, p));
            }
            emitters_.push_back(triangle);
        }
    }
}

RadianceSh PlainTracer::gather(glm::vec3 origin, uint32_t sample_count, uint64_t seed) {
    engine_.seed(seed);
    RadianceShSum sum;
    for (uint32_t i = 0; i < sample_count; ++i) {
        const float u = next();
        const glm::vec3 direction = uniform_direction({u, next()});
        sum.add(direction, trace({origin, direction}));
    }
    return radiance_from_sum(sum, 4.0 * std::numbers::pi / sample_count);
}

/// Emission counts at the first vertex only; `reflected_light` counts it at later ones.
glm::vec3 PlainTracer::trace(Ray ray) {
    glm::vec3 radiance(0.0f), throughput(1.0f);
    for (uint32_t bounce = 0;; ++bounce) {
        const auto surface = traced_.intersect(ray);
        if (!surface) {
            return radiance + throughput * environment_radiance(scene_.environment, ray.direction);
        }
        if (surface->is_back_face) return radiance;
        if (bounce == 0) radiance += surface->emission;
        const glm::vec3 origin = TraceScene::ray_origin(*surface, surface->geometric_normal);
        throughput *= surface->albedo;
        if (bounce >= 3) {
            const float survival =
                std::min(0.95f, std::max({throughput.r, throughput.g, throughput.b}));
            if (!(next() < survival)) return radiance;
            throughput /= survival;
        }
        radiance += throughput * reflected_light(*surface, origin);
        const float u = next();
        ray = {origin, sample_cosine_hemisphere(surface->geometric_normal, {u, next()})};
    }
}

glm::vec3 PlainTracer::reflected_light(const Surface& surface, glm::vec3 origin) {
    const size_t count = lights_.size() + emitters_.size();
    if (count == 0) return glm::vec3(0.0f);
    const auto chosen =
        std::min(count - 1, static_cast<size_t>(next() * static_cast<float>(count)));
    const auto per_chance = static_cast<float>(count) / kPi;
    if (chosen >= lights_.size()) {
        return per_chance * light_of(emitters_[chosen - lights_.size()], surface, origin);
    }
    const Illumination light = illuminate(lights_[chosen], surface.position);
    const float cosine = glm::dot(surface.geometric_normal, light.to_light);
    if (cosine <= 0.0f || traced_.occluded({origin, light.to_light, light.distance})) {
        return glm::vec3(0.0f);
    }
    return per_chance * cosine * light.irradiance;
}

/// Irradiance from one point of a triangle, divided by the probability density of that point.
glm::vec3 PlainTracer::light_of(const Triangle& triangle, const Surface& surface,
                                glm::vec3 origin) {
    const float root = std::sqrt(next());
    const float v = next() * root;
    const glm::vec3 first = triangle[1] - triangle[0], second = triangle[2] - triangle[0];
    const glm::vec3 point = triangle[0] + (1.0f - root) * first + v * second;
    const glm::vec3 double_area = glm::cross(first, second);
    const glm::vec3 offset = point - origin;
    const float distance = glm::length(offset);
    const glm::vec3 to_light = offset / distance;
    const float cosine = glm::dot(surface.geometric_normal, to_light);
    if (!(cosine > 0.0f)) return glm::vec3(0.0f);
    const auto seen = traced_.intersect({origin, to_light});
    if (!seen || seen->is_back_face) return glm::vec3(0.0f);
    if (glm::distance(seen->position, point) > 1e-4f + 1e-4f * distance) return glm::vec3(0.0f);
    const float projected = 0.5f * std::abs(glm::dot(double_area, to_light));
    return seen->emission * (cosine * projected / (distance * distance));
}

}  // namespace tetralight::bench
