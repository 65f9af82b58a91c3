// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_estimator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <tetralight/bake/detail/mis.h>
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

/// Where the paths of an estimate start, and how their light is summed.
class Receiver {
  public:
    Receiver(glm::vec3 origin, uint64_t key, const DirectionSet& directions)
        : sample_count_(directions.size()), position_(origin), directions_(&directions) {
        RandomStream rotation(key, static_cast<uint64_t>(Purpose::Rotation));
        frame_ = sample_rotation(rotation);
    }

    Receiver(glm::vec3 position, const TexelSurface& surface, uint64_t key, uint32_t sample_count)
        : sample_count_(sample_count),
          position_(position),
          normal_(surface.normal),
          origins_(surface.origins),
          directions_key_(key_of(key, Purpose::Rotation)),
          frame_(frame_around(surface.normal)) {}

    [[nodiscard]] uint32_t sample_count() const { return sample_count_; }

    [[nodiscard]] uint32_t origin_count() const {
        return std::max(1u, static_cast<uint32_t>(origins_.size()));
    }

    /// For the weights of openings.
    [[nodiscard]] ShadingPoint shading_point() const { return {position_, normal_}; }

    /// Samples of a texel that follow each other start at one origin: they are well distributed.
    [[nodiscard]] glm::vec3 origin(uint32_t sample, uint32_t count) const {
        if (origins_.empty()) return position_;
        return position_ + origins_[size_t{sample} * origins_.size() / count];
    }

    [[nodiscard]] glm::vec3 direction(uint32_t sample) const {
        if (directions_ != nullptr) return frame_ * (*directions_)[sample];
        return sample_start(normal_, owen_sobol2(sample, directions_key_));
    }

    /// A direction in the frame of the coefficients.
    [[nodiscard]] glm::vec3 local(glm::vec3 direction) const {
        return is_probe() ? direction : direction * frame_;
    }

    /// True if light from there counts.
    [[nodiscard]] bool sees(glm::vec3 direction) const {
        return is_probe() || glm::dot(normal_, direction) > 0.0f;
    }

    /// Density of uniform directions over that of `direction`.
    [[nodiscard]] float relative_weight(glm::vec3 direction) const {
        return is_probe() ? 1.0f : detail::kSpherePdf / start_pdf(normal_, direction);
    }

    [[nodiscard]] PathStart start(uint32_t sample, uint32_t count) const {
        return {.origin = origin(sample, count), .normal = normal_};
    }

    /// Solid angle from which light arrives.
    [[nodiscard]] double solid_angle() const {
        return is_probe() ? kSphereSolidAngle : 0.5 * kSphereSolidAngle;
    }

  private:
    [[nodiscard]] bool is_probe() const { return directions_ != nullptr; }

    uint32_t sample_count_;
    glm::vec3 position_;
    glm::vec3 normal_{0.0f};
    std::span<const glm::vec3> origins_;
    const DirectionSet* directions_ = nullptr;
    uint64_t directions_key_ = 0;
    glm::mat3 frame_;
};

class Estimator {
  public:
    Estimator(const PathTracer& tracer, const Receiver& receiver, uint64_t key)
        : tracer_(tracer),
          receiver_(receiver),
          key_(key),
          light_groups_(LightGroupLayout(tracer.plan())) {
        estimate_.sample_count = receiver.sample_count();
        if (!tracer.openings().is_empty()) {
            opening_weights_ = tracer.openings().weights(receiver.shading_point());
        }
        if (!tracer.can_sample_emission()) return;
        light_sample_count_ = std::max(1u, receiver.sample_count() / kSamplesPerLightSample);
        paths_per_light_sample_ =
            static_cast<float>(receiver.sample_count()) / static_cast<float>(light_sample_count_);
    }

    [[nodiscard]] ProbeEstimate run() {
        add_paths();
        if (light_sample_count_ > 0) add_emission();
        if (!tracer_.openings().is_empty()) add_openings();
        if (!tracer_.settings().is_reflected_only) add_baked_lights();
        if (tracer_.settings().bounces == 0) {
            estimate_.cut.last_radiance = estimate_.sample_count *
                                          (kSphereSolidAngle / receiver_.solid_angle()) *
                                          glm::dvec3(estimate_.radiance.coefficients[0]);
        }
        estimate_.light_groups = light_groups_.values();
        return std::move(estimate_);
    }

  private:
    [[nodiscard]] PathStart start(uint32_t sample, uint32_t count) const {
        PathStart start = receiver_.start(sample, count);
        start.paths_per_light_sample = paths_per_light_sample_;
        if (!tracer_.openings().is_empty()) start.opening_weights = &opening_weights_;
        return start;
    }

    void add_paths();
    void add_emission();
    void add_openings();
    void add_baked_light(size_t light_index, uint64_t key, uint32_t count);
    void add_baked_lights();

    const PathTracer& tracer_;
    const Receiver& receiver_;
    const uint64_t key_;
    Openings::Weights opening_weights_;
    uint32_t light_sample_count_ = 0;
    float paths_per_light_sample_ = std::numeric_limits<float>::infinity();
    ProbeEstimate estimate_;
    LightGroupSum light_groups_;
};

/// One path per sample.
void Estimator::add_paths() {
    const uint64_t paths_key = key_of(key_, Purpose::Paths);
    const bool has_light_groups = tracer_.plan().has_light_groups();
    PathLightGroups path_groups(tracer_.plan().layer_count);
    const uint32_t count = receiver_.sample_count();
    const double solid_angle = kSphereSolidAngle / count;
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        PathStart path = start(i, count);
        path.direction = receiver_.direction(i);
        if (has_light_groups) path_groups.clear();
        const PathSample sample =
            tracer_.trace(path, Sampler(paths_key, i), has_light_groups ? &path_groups : nullptr);
        const glm::vec3 direction = receiver_.local(path.direction);
        const float weight = receiver_.relative_weight(path.direction);
        sum.add(direction, sample.radiance * weight);
        if (has_light_groups)
            light_groups_.add(direction, path_groups, solid_angle * double{weight});
        estimate_.back_face_count += sample.hit_back_face;
        estimate_.ray_count += sample.ray_count;
        estimate_.cut.add(cut_light(sample));
    }
    estimate_.radiance += radiance_from_sum(sum, solid_angle);
}

/// The direct light of sampled emissive triangles and sky directions.
void Estimator::add_emission() {
    const uint64_t emission_key = key_of(key_, Purpose::Emission);
    const uint32_t count = light_sample_count_;
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        const PathStart path = start(i, count);
        Sampler sampler(emission_key, i);
        for (const LightKind kind : {LightKind::Triangle, LightKind::Sky}) {
            if (!tracer_.light_sampler().has(kind)) continue;
            const LightSample sample = tracer_.sample_emission(kind, path, sampler);
            ++estimate_.ray_count;
            if (sample.irradiance == glm::vec3(0.0f)) continue;
            const glm::vec3 direction = receiver_.local(sample.to_light);
            sum.add(direction, sample.irradiance);
            light_groups_.add(direction, tracer_.layer_of(kind, sample), sample.irradiance,
                              1.0 / count);
        }
    }
    estimate_.radiance += radiance_from_sum(sum, 1.0 / count);
}

/// Adds light that enters through openings: two samples for each path.
void Estimator::add_openings() {
    const uint64_t openings_key = key_of(key_, Purpose::Openings);
    const float light_samples =
        std::isinf(paths_per_light_sample_) ? 0.0f : 1.0f / paths_per_light_sample_;
    std::array<PathLightGroups, 2> path_groups{PathLightGroups(tracer_.plan().layer_count),
                                               PathLightGroups(tracer_.plan().layer_count)};
    std::array<PathLightGroups*, 2> used_groups{};
    if (tracer_.plan().has_light_groups()) used_groups = {&path_groups[0], &path_groups[1]};
    const uint32_t count = receiver_.sample_count();
    const double weight = 1.0 / count;
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        for (PathLightGroups& groups : path_groups) groups.clear();
        const auto samples =
            tracer_.draw_from_openings(start(i, count), light_samples, Sampler(openings_key, i),
                                       used_groups, estimate_.ray_count);
        for (size_t k = 0; k < samples.size(); ++k) {
            if (samples[k].irradiance == glm::vec3(0.0f)) continue;
            const glm::vec3 direction = receiver_.local(samples[k].to_light);
            sum.add(direction, samples[k].irradiance);
            light_groups_.add(direction, path_groups[k], weight);
        }
    }
    estimate_.radiance += radiance_from_sum(sum, weight);
}

/// Adds the direct light of one baked light, with `count` shadow rays.
void Estimator::add_baked_light(size_t light_index, uint64_t key, uint32_t count) {
    const Light& light = tracer_.baked_lights()[light_index];
    const uint32_t layer = tracer_.layer_of_baked_light(light_index);
    RadianceShSum sum;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 origin = receiver_.origin(i, count);
        Sampler sampler(key, i);
        const LightSample sample = sample_light(light, origin, sampler.next2());
        if (sample.irradiance == glm::vec3(0.0f) || !receiver_.sees(sample.to_light)) continue;
        ++estimate_.ray_count;
        if (tracer_.occluded(origin, sample, sampler.next())) continue;
        const glm::vec3 direction = receiver_.local(sample.to_light);
        sum.add(direction, sample.irradiance);
        light_groups_.add(direction, layer, sample.irradiance, 1.0 / count);
    }
    estimate_.radiance += radiance_from_sum(sum, 1.0 / count);
}

void Estimator::add_baked_lights() {
    const std::vector<Light>& lights = tracer_.baked_lights();
    const auto light_count = std::max<size_t>(1, lights.size());
    const auto soft_count = static_cast<uint32_t>(std::max<size_t>(
        receiver_.origin_count(), estimate_.sample_count / (kSamplesPerShadowRay * light_count)));
    uint64_t light_key = key_of(key_, Purpose::BakedLights);
    for (size_t i = 0; i < lights.size(); ++i) {
        const bool is_hard = has_hard_shadows(lights[i]) && !tracer_.trace_scene().has_blending();
        add_baked_light(i, light_key, is_hard ? receiver_.origin_count() : soft_count);
        light_key = detail::mix(light_key + detail::kGoldenRatio64);
    }
}

}  // namespace

ProbeEstimate estimate_probe(const PathTracer& tracer, glm::vec3 origin, uint64_t key,
                             const DirectionSet& directions) {
    const Receiver receiver(origin, key, directions);
    return Estimator(tracer, receiver, key).run();
}

ProbeEstimate estimate_texel(const PathTracer& tracer, glm::vec3 position,
                             const TexelSurface& surface, uint64_t key, uint32_t sample_count) {
    const Receiver receiver(position, surface, key, sample_count);
    return Estimator(tracer, receiver, key).run();
}

}  // namespace tetralight
