// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_estimator.h>

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/light_group_sum.h>
#include <tetralight/bake/sampling/mix.h>
#include <tetralight/bake/sampling/sampling.h>

namespace tetralight {
namespace {

constexpr double kSphereSolidAngle = 4.0 * std::numbers::pi;

/// Samples per light sample at the probe.
constexpr uint32_t kSamplesPerLightSample = 2;

/// Samples per shadow ray to a `Baked` light.
constexpr uint32_t kSamplesPerShadowRay = 4;

/// The independent random decisions of an estimate. Each has its own key.
enum class Purpose : uint64_t { Rotation, Paths, Emission, BakedLights };

uint64_t key_of(uint64_t key, Purpose purpose) {
    return detail::mix(key + (static_cast<uint64_t>(purpose) + 1) * detail::kGoldenRatio64);
}

CutLight cut_light(const PathSample& sample) {
    constexpr double kBasis = 0.28209479177387814;  // Y_0
    return {kSphereSolidAngle * kBasis * glm::dvec3(sample.last_light),
            static_cast<double>(sample.last_throughput),
            static_cast<double>(sample.cut_throughput)};
}

/// What an estimate gathers: the sum, and the light groups.
struct Gathered {
    ProbeEstimate estimate;
    LightGroupSum light_groups;
};

/// Adds one path per direction of the set. The direction of `start` is ignored.
void add_paths(const PathTracer& tracer, const PathStart& start, const DirectionSet& directions,
               uint64_t key, Gathered& gathered) {
    ProbeEstimate& estimate = gathered.estimate;
    RandomStream rotation_stream(key, static_cast<uint64_t>(Purpose::Rotation));
    const glm::mat3 rotation = sample_rotation(rotation_stream);
    const uint64_t paths_key = key_of(key, Purpose::Paths);
    const bool has_light_groups = tracer.plan().has_light_groups();
    PathLightGroups light_groups(tracer.plan().layer_count);
    RadianceShSum sum;
    PathStart path = start;
    for (uint32_t i = 0; i < directions.size(); ++i) {
        path.direction = rotation * directions[i];
        if (has_light_groups) light_groups.clear();
        const PathSample sample =
            tracer.trace(path, Sampler(paths_key, i), has_light_groups ? &light_groups : nullptr);
        sum.add(path.direction, sample.radiance);
        if (has_light_groups)
            gathered.light_groups.add(path.direction, light_groups,
                                      kSphereSolidAngle / directions.size());
        estimate.back_face_count += sample.hit_back_face;
        estimate.ray_count += sample.ray_count;
        estimate.cut.add(cut_light(sample));
    }
    estimate.radiance += radiance_from_sum(sum, kSphereSolidAngle / directions.size());
}

/// Adds the direct light of `count` sampled emissive triangles and `count` sampled sky directions.
void add_emission(const PathTracer& tracer, glm::vec3 origin, uint64_t key, uint32_t count,
                  Gathered& gathered) {
    ProbeEstimate& estimate = gathered.estimate;
    const double samples_each = static_cast<double>(estimate.sample_count) / count;
    const auto path_pdf = static_cast<float>(samples_each / kSphereSolidAngle);
    const uint64_t emission_key = key_of(key, Purpose::Emission);
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        Sampler sampler(emission_key, i);
        for (const LightKind kind : {LightKind::Triangle, LightKind::Sky}) {
            if (!tracer.light_sampler().has(kind)) continue;
            const LightSample sample = tracer.sample_emission(kind, {origin}, path_pdf, sampler);
            ++estimate.ray_count;
            if (sample.irradiance == glm::vec3(0.0f)) continue;
            sum.add(sample.to_light, sample.irradiance);
            gathered.light_groups.add(sample.to_light, tracer.layer_of(kind, sample),
                                      sample.irradiance, 1.0 / count);
        }
    }
    estimate.radiance += radiance_from_sum(sum, 1.0 / count);
}

/// Adds the direct light of one baked light, with `count` shadow rays.
void add_baked_light(const PathTracer& tracer, size_t light_index, glm::vec3 origin, uint64_t key,
                     uint32_t count, Gathered& gathered) {
    ProbeEstimate& estimate = gathered.estimate;
    const Light& light = tracer.baked_lights()[light_index];
    const uint32_t layer = tracer.layer_of_baked_light(light_index);
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        Sampler sampler(key, i);
        const LightSample sample = sample_light(light, origin, sampler.next2());
        if (sample.irradiance == glm::vec3(0.0f)) continue;
        ++estimate.ray_count;
        if (tracer.occluded(origin, sample, sampler.next())) continue;
        sum.add(sample.to_light, sample.irradiance);
        gathered.light_groups.add(sample.to_light, layer, sample.irradiance, 1.0 / count);
    }
    estimate.radiance += radiance_from_sum(sum, 1.0 / count);
}

void add_baked_lights(const PathTracer& tracer, glm::vec3 origin, uint64_t key,
                      Gathered& gathered) {
    const std::vector<Light>& lights = tracer.baked_lights();
    const auto light_count = std::max<size_t>(1, lights.size());
    const auto soft_count = static_cast<uint32_t>(
        std::max<size_t>(1, gathered.estimate.sample_count / (kSamplesPerShadowRay * light_count)));
    uint64_t light_key = key_of(key, Purpose::BakedLights);
    for (size_t i = 0; i < lights.size(); ++i) {
        const bool is_hard = has_hard_shadows(lights[i]) && !tracer.trace_scene().has_blending();
        add_baked_light(tracer, i, origin, light_key, is_hard ? 1 : soft_count, gathered);
        light_key = detail::mix(light_key + detail::kGoldenRatio64);
    }
}

}  // namespace

ProbeEstimate estimate_probe(const PathTracer& tracer, glm::vec3 origin, uint64_t key,
                             const DirectionSet& directions) {
    const uint32_t sample_count = directions.size();
    Gathered gathered{{}, LightGroupSum(LightGroupLayout(tracer.plan()))};
    gathered.estimate.sample_count = sample_count;
    if (tracer.can_sample_emission()) {
        const uint32_t light_sample_count = std::max(1u, sample_count / kSamplesPerLightSample);
        const double pdf = sample_count / (kSphereSolidAngle * light_sample_count);
        const PathStart start{.origin = origin, .pdf = static_cast<float>(pdf)};
        add_paths(tracer, start, directions, key, gathered);
        add_emission(tracer, origin, key, light_sample_count, gathered);
    } else {
        add_paths(tracer, {.origin = origin}, directions, key, gathered);
    }
    add_baked_lights(tracer, origin, key, gathered);
    if (tracer.bounces() == 0) {
        gathered.estimate.cut.last_radiance =
            static_cast<double>(sample_count) *
            glm::dvec3(gathered.estimate.radiance.coefficients[0]);
    }
    gathered.estimate.light_groups = gathered.light_groups.values();
    return std::move(gathered.estimate);
}

}  // namespace tetralight
