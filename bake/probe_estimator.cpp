// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_estimator.h>

#include <algorithm>
#include <array>
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
enum class Purpose : uint64_t { Rotation, Paths, Emission, BakedLights, Openings };

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
void add_emission(const PathTracer& tracer, const PathStart& start, uint64_t key, uint32_t count,
                  Gathered& gathered) {
    ProbeEstimate& estimate = gathered.estimate;
    const uint64_t emission_key = key_of(key, Purpose::Emission);
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        Sampler sampler(emission_key, i);
        for (const LightKind kind : {LightKind::Triangle, LightKind::Sky}) {
            if (!tracer.light_sampler().has(kind)) continue;
            const LightSample sample = tracer.sample_emission(kind, start, sampler);
            ++estimate.ray_count;
            if (sample.irradiance == glm::vec3(0.0f)) continue;
            sum.add(sample.to_light, sample.irradiance);
            gathered.light_groups.add(sample.to_light, tracer.layer_of(kind, sample),
                                      sample.irradiance, 1.0 / count);
        }
    }
    estimate.radiance += radiance_from_sum(sum, 1.0 / count);
}

/// Adds light that enters through openings: two samples for each path.
void add_openings(const PathTracer& tracer, const PathStart& start, uint64_t key,
                  float light_samples, Gathered& gathered) {
    ProbeEstimate& estimate = gathered.estimate;
    const uint64_t openings_key = key_of(key, Purpose::Openings);
    std::array<PathLightGroups, 2> light_groups{PathLightGroups(tracer.plan().layer_count),
                                                PathLightGroups(tracer.plan().layer_count)};
    std::array<PathLightGroups*, 2> used_groups{};
    if (tracer.plan().has_light_groups()) used_groups = {&light_groups[0], &light_groups[1]};
    const double weight = 1.0 / estimate.sample_count;
    RadianceShSum sum;
    for (uint32_t i = 0; i < estimate.sample_count; ++i) {
        for (PathLightGroups& groups : light_groups) groups.clear();
        const auto samples = tracer.draw_from_openings(
            start, light_samples, Sampler(openings_key, i), used_groups, estimate.ray_count);
        for (size_t k = 0; k < samples.size(); ++k) {
            if (samples[k].irradiance == glm::vec3(0.0f)) continue;
            sum.add(samples[k].to_light, samples[k].irradiance);
            gathered.light_groups.add(samples[k].to_light, light_groups[k], weight);
        }
    }
    estimate.radiance += radiance_from_sum(sum, weight);
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
    PathStart start{.origin = origin};
    Openings::Weights opening_weights;
    if (!tracer.openings().is_empty()) {
        opening_weights = tracer.openings().weights({origin});
        start.opening_weights = &opening_weights;
    }
    float light_samples = 0.0f;  // per path
    if (tracer.can_sample_emission()) {
        const uint32_t light_sample_count = std::max(1u, sample_count / kSamplesPerLightSample);
        light_samples = static_cast<float>(light_sample_count) / static_cast<float>(sample_count);
        start.pdf = static_cast<float>(sample_count / (kSphereSolidAngle * light_sample_count));
        add_paths(tracer, start, directions, key, gathered);
        add_emission(tracer, start, key, light_sample_count, gathered);
    } else {
        add_paths(tracer, start, directions, key, gathered);
    }
    if (start.opening_weights != nullptr) add_openings(tracer, start, key, light_samples, gathered);
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
