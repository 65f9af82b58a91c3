// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/probes/sh.h>

namespace tetralight::test {

/// The light transport of a bake in its simplest form: paths in cosine-weighted directions find
/// emission and sky by chance, every light that rays cannot hit is sampled at every surface, and
/// dim paths end by Russian roulette. Slow, and its mean is right by inspection.
class SimpleTracer {
  public:
    /// Keeps a reference.
    SimpleTracer(const Scene& scene, const TraceScene& traced, uint32_t bounces)
        : environment_(scene.environment), traced_(traced), bounces_(bounces) {
        for (const Light& light : scene.lights) {
            if (light.mode == LightMode::Realtime) continue;
            Light bounced = traced.render_from_world(light);
            if (light.mode == LightMode::Baked) baked_lights_.push_back(bounced);
            bounced.intensity *= light.indirect_multiplier;
            bounced_lights_.push_back(bounced);
        }
    }

    /// One estimate of the light at a position in render space. Directions are even over the
    /// sphere, everything else is independent random. With a `normal`: of its hemisphere, in the
    /// frame of `estimate_texel`.
    [[nodiscard]] RadianceSh gather(glm::vec3 origin, uint64_t key, uint32_t sample_count,
                                    glm::vec3 normal = glm::vec3(0.0f)) const {
        const bool is_texel = normal != glm::vec3(0.0f);
        const glm::mat3 frame = is_texel ? frame_around(normal) : glm::mat3(1.0f);
        const auto counts = [&](glm::vec3 direction) {
            return !is_texel || glm::dot(normal, direction) > 0.0f;
        };
        RandomStream random(key, 0x51);
        const glm::mat3 rotation = sample_rotation(random);
        RadianceShSum paths, direct;
        for (uint32_t i = 0; i < sample_count; ++i) {
            const glm::vec3 direction = rotation * spherical_fibonacci(i, sample_count);
            if (counts(direction)) paths.add(direction * frame, trace({origin, direction}, random));
            for (const Light& light : baked_lights_) {
                const LightSample sample = sample_light(light, origin, random.next2());
                if (counts(sample.to_light) && is_visible(origin, sample, random))
                    direct.add(sample.to_light * frame, sample.irradiance);
            }
        }
        RadianceSh light = radiance_from_sum(paths, 4.0 * std::numbers::pi / sample_count);
        light += radiance_from_sum(direct, 1.0 / sample_count);
        return light;
    }

  private:
    [[nodiscard]] glm::vec3 trace(Ray ray, RandomStream& random) const {
        glm::vec3 radiance(0.0f), throughput(1.0f);
        for (uint32_t bounce = 0;; ++bounce) {
            const auto surface = traced_.intersect(ray);
            if (!surface)
                return radiance + throughput * environment_radiance(environment_, ray.direction);
            if (surface->is_back_face) return radiance;
            radiance += throughput * surface->emission;
            if (bounce == bounces_) return radiance;
            throughput *= surface->albedo * roulette(throughput * surface->albedo, random);
            if (throughput == glm::vec3(0.0f)) return radiance;
            const glm::vec3 normal = surface->geometric_normal;
            const glm::vec3 origin = TraceScene::ray_origin(*surface, normal);
            radiance += throughput * reflected_light(*surface, origin, random);
            ray = {origin, sample_cosine_hemisphere(normal, random.next2())};
        }
    }

    /// Inverse of the probability that a path of this throughput continues; 0 if it ends. Of the
    /// dim paths that continue, none becomes brighter than `dim`.
    [[nodiscard]] static float roulette(glm::vec3 throughput, RandomStream& random) {
        constexpr float dim = 0.1f;
        const float largest = std::max({throughput.x, throughput.y, throughput.z});
        if (largest >= dim) return 1.0f;
        return random.next() * dim < largest ? dim / largest : 0.0f;
    }

    /// Divided by the albedo.
    [[nodiscard]] glm::vec3 reflected_light(const Surface& surface, glm::vec3 origin,
                                            RandomStream& random) const {
        glm::vec3 irradiance(0.0f);
        for (const Light& light : bounced_lights_) {
            const LightSample sample = sample_light(light, surface.position, random.next2());
            const float cosine = glm::dot(surface.geometric_normal, sample.to_light);
            if (cosine > 0.0f && is_visible(origin, sample, random))
                irradiance += cosine * sample.irradiance;
        }
        return irradiance * std::numbers::inv_pi_v<float>;
    }

    /// Blended surfaces decide by the bits of the ray whether they stop it: a random factor on its
    /// direction makes the decisions independent.
    [[nodiscard]] bool is_visible(glm::vec3 origin, const LightSample& sample,
                                  RandomStream& random) const {
        const float factor = 1.0f + random.next();
        if (sample.irradiance == glm::vec3(0.0f)) return false;
        if (sample.is_distant) return !traced_.occluded({origin, factor * sample.to_light});
        return !traced_.occluded({origin, factor * (sample.target - origin), 1.0f / factor});
    }

    const Environment& environment_;
    const TraceScene& traced_;
    uint32_t bounces_;
    std::vector<Light> bounced_lights_, baked_lights_;
};

}  // namespace tetralight::test
