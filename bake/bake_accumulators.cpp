// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_accumulators.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <tetralight/bake/ambient_occlusion.h>
#include <tetralight/bake/layer_errors.h>
#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/occlusion.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/round_plan.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/texel_light.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/sh.h>

namespace tetralight {
namespace {

using Clock = std::chrono::steady_clock;

/// What a message calls a place.
const char* name_of(const BakePlaces& places) {
    return places.surfaces.texels.empty() ? "probe" : "texel";
}

Status check_positions(const BakePlaces& places) {
    for (size_t i = 0; i < places.positions.size(); ++i) {
        const glm::dvec3& p = places.positions[i];
        if (!is_finite(p)) {
            const std::string value = str_cat("(", p.x, ", ", p.y, ", ", p.z, ")");
            return Error{ErrorCode::InvalidArgument, str_cat("positions[", i, "]"), value,
                         str_cat(name_of(places), " ", i, ": position is not finite ", value)};
        }
    }
    return Ok{};
}

/// Returns invalid_argument if the irradiance of a probe exceeds the range of float.
Status check_light(const BakePlaces& places, std::span<const ProbeAccumulator> accumulators) {
    for (size_t i = 0; i < accumulators.size(); ++i) {
        const IrradianceSh irradiance = irradiance_from_radiance(accumulators[i].radiance());
        const auto is_good = [](const glm::vec3& c) { return is_finite(c); };
        if (std::ranges::all_of(irradiance.coefficients, is_good)) continue;
        const glm::dvec3& p = places.positions[i];
        return Error{ErrorCode::InvalidArgument,
                     str_cat(name_of(places), " ", i, " at (", p.x, ", ", p.y, ", ", p.z,
                             "): its light is too bright for floats; a light, an emission or the "
                             "sky is far out of range")};
    }
    return Ok{};
}

/// The inputs and outputs of a bake.
struct Work {
    const TraceScene& trace_scene;
    const PathTracer& tracer;
    const BakePlaces& places;
    std::span<ProbeAccumulator> accumulators;
    const LightGroupRows& light_groups;
    /// The lights of the scene in render space.
    std::vector<Light> lights;
    /// `mean_layer_light`; empty if layers have no target error.
    std::vector<double> mean_layer_light;
};

/// True for the one estimate of a place that includes single values, such as its occlusion: the
/// first of the first round.
bool has_single_values(const LightGroupLayout& layout, uint64_t round, uint32_t number) {
    return layout.has_single_values() && round == 0 && number == 0;
}

/// Calls a function at regular intervals, which grow so that the calls take at most a share of the
/// time.
class Periodic {
  public:
    /// `pause`: time between two calls over the time of a call, at least.
    Periodic(const std::function<void()>& work, double seconds, int pause)
        : work_(work),
          pause_(pause),
          interval_(
              std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {
    }

    void run_if_due() {
        const auto now = Clock::now();
        if (!work_ || now - last_ < interval_) return;
        work_();
        last_ = Clock::now();
        interval_ = std::max(interval_, pause_ * (last_ - now));
    }

  private:
    const std::function<void()>& work_;
    int pause_;
    Clock::duration interval_;
    Clock::time_point last_ = Clock::now();
};

class AccumulatorBaker {
  public:
    AccumulatorBaker(const Work& work, const BakeSettings& settings, const BakeHooks& hooks)
        : work_(work),
          settings_(settings),
          plan_(settings, work.places.measure()),
          layout_(settings.plan),
          hooks_(hooks),
          progress_(hooks.progress, work.places.positions.size(), plan_.has_target()) {
        for (uint32_t i = 0; i < work.accumulators.size(); ++i) {
            const ProbeAccumulator& accumulator = work.accumulators[i];
            const float layer_error = worst_layer_error(i);
            progress_.resume_probe(accumulator.sample_count,
                                   plan_.expected_samples(accumulator, layer_error),
                                   state_of(accumulator, layer_error));
        }
    }

    Status run() {
        std::vector<uint32_t> probes = next_round();
        if (hooks_.begin && !probes.empty()) {
            if (auto status = hooks_.begin(); !status) return status;
        }
        sampling_start_ = Clock::now();
        for (; !probes.empty(); probes = next_round()) {
            const uint64_t round = work_.accumulators[probes[0]].round_count;
            if (!has_time_for(round, probes.size())) {
                if (hooks_.out_of_time) hooks_.out_of_time(plan_.samples_before(round));
                break;
            }
            const size_t step = probes_at_once(round);
            for (size_t begin = 0; begin < probes.size(); begin += step) {
                const size_t count = std::min(step, probes.size() - begin);
                bake_round(std::span(probes).subspan(begin, count), round);
                if (progress_.is_cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
                sampled_count_ += count * plan_.samples_in_round(round);
                save_.run_if_due();
                preview_.run_if_due();
            }
        }
        progress_.finish();
        return Ok{};
    }

  private:
    /// Of the probes that need a further round, those with the fewest rounds so far.
    [[nodiscard]] std::vector<uint32_t> next_round() const {
        std::vector<uint32_t> probes;
        uint64_t round = ~uint64_t{0};
        for (uint32_t i = 0; i < work_.accumulators.size(); ++i) {
            const ProbeAccumulator& accumulator = work_.accumulators[i];
            if (accumulator.round_count > round) continue;
            if (plan_.is_done(accumulator, worst_layer_error(i))) continue;
            if (accumulator.round_count < round) probes.clear();
            round = accumulator.round_count;
            probes.push_back(i);
        }
        return probes;
    }

    /// Probes per batch: a few seconds of work, and a few megabytes of estimates.
    [[nodiscard]] size_t probes_at_once(uint64_t round) const {
        return std::clamp<size_t>(hooks_.samples_between_saves / plan_.samples_in_round(round), 16,
                                  4096);
    }

    void bake_round(std::span<const uint32_t> probes, uint64_t round) {
        const uint32_t estimates_each = plan_.estimates_in_round(round);
        std::vector<ProbeEstimate> estimates(probes.size() * estimates_each);
        std::vector<std::atomic<uint32_t>> missing(probes.size());
        for (auto& count : missing) count.store(estimates_each, std::memory_order_relaxed);
        progress_.set_worst_error(worst_error_except(probes));
        // The first estimates may have one sample more than the last ones.
        const DirectionSet first(plan_.samples_in_estimate(round, 0));
        const DirectionSet last(plan_.samples_in_estimate(round, estimates_each - 1));

        parallel_for(estimates.size(), settings_.thread_count, [&](size_t item) {
            if (progress_.is_cancelled()) return;
            const size_t index = item / estimates_each;
            const auto number = static_cast<uint32_t>(item - index * estimates_each);
            const bool is_first = plan_.samples_in_estimate(round, number) == first.size();
            estimates[item] = estimate(probes[index], round, number, is_first ? first : last);
            if (missing[index].fetch_sub(1, std::memory_order_acq_rel) == 1) {
                const auto all =
                    std::span(estimates).subspan(index * estimates_each, estimates_each);
                end_round(probes[index], all);
            }
            progress_.add_rays(estimates[item].ray_count);
        });
    }

    [[nodiscard]] ProbeEstimate estimate(uint32_t probe, uint64_t round, uint32_t number,
                                         const DirectionSet& directions) const {
        const glm::dvec3& position = work_.places.positions[probe];
        const glm::vec3 origin = work_.trace_scene.render_from_world(position);
        const uint64_t key = estimate_key(probe_key(settings_.seed, position), round, number);
        const bool is_texel = plan_.measure() == ErrorMeasure::OwnNormal;
        ProbeEstimate estimate =
            is_texel ? estimate_texel(work_.tracer, origin, work_.places.surfaces[probe], key,
                                      directions.size())
                     : estimate_probe(work_.tracer, origin, key, directions);
        if (is_texel) keep_half(estimate, number < plan_.estimates_in_round(round) / 2);
        if (has_single_values(layout_, round, number)) {
            add_single_values(probe, origin, key, estimate.light_groups);
        }
        return estimate;
    }

    void add_single_values(uint32_t probe, glm::vec3 origin, uint64_t key,
                           std::vector<float>& values) const {
        const bool is_texel = plan_.measure() == ErrorMeasure::OwnNormal;
        if (layout_.has_occlusion) {
            const OcclusionLights& lights = work_.light_groups.occlusion_lights[probe];
            const glm::vec4 occlusion =
                is_texel ? texel_occlusion(work_.tracer, work_.lights, lights, origin,
                                           work_.places.surfaces[probe], key)
                         : probe_occlusion(work_.tracer, work_.lights, lights, origin, key);
            for (int i = 0; i < 4; ++i) values.push_back(occlusion[i]);
        }
        if (layout_.has_ambient_occlusion) {
            values.push_back(ambient_occlusion(work_.trace_scene, origin,
                                               work_.places.surfaces[probe],
                                               settings_.plan.ambient_occlusion_distance, key));
        }
    }

    void end_round(uint32_t probe, std::span<const ProbeEstimate> estimates) {
        ProbeAccumulator& accumulator = work_.accumulators[probe];
        const uint64_t expected_before =
            plan_.expected_samples(accumulator, worst_layer_error(probe));
        const uint64_t samples_before = accumulator.sample_count;
        add_light_groups(probe, accumulator.round_count, estimates);
        accumulator.add_round(estimates, plan_.measure());
        const float layer_error = worst_layer_error(probe);
        progress_.add_round({.samples = accumulator.sample_count - samples_before,
                             .expected_samples = plan_.expected_samples(accumulator, layer_error),
                             .expected_samples_before = expected_before,
                             .is_first = accumulator.round_count == 1,
                             .state = state_of(accumulator, layer_error),
                             .sampling_error = accumulator.sampling_error(plan_.measure())});
    }

    void add_light_groups(uint32_t probe, uint64_t round,
                          std::span<const ProbeEstimate> estimates) {
        const auto row = row_of(probe);
        const size_t summed = layout_.occlusion_begin();
        for (const ProbeEstimate& estimate : estimates) {
            const auto weight = static_cast<double>(estimate.sample_count);
            for (size_t i = 0; i < summed; ++i) {
                row[i] += weight * static_cast<double>(estimate.light_groups[i]);
            }
        }
        add_layer_variances(layout_, estimates, row, plan_.measure());
        if (!has_single_values(layout_, round, 0)) return;
        for (size_t i = summed; i < layout_.variance_begin(); ++i) {
            row[i] = static_cast<double>(estimates[0].light_groups[i]);
        }
    }

    [[nodiscard]] std::span<double> row_of(uint32_t probe) const {
        return work_.light_groups.rows.subspan(probe * layout_.size(), layout_.size());
    }

    /// 0 if the plan has no target for layers.
    [[nodiscard]] float worst_layer_error(uint32_t probe) const {
        if (work_.mean_layer_light.empty()) return 0.0f;
        return tetralight::worst_layer_error(layout_, work_.accumulators[probe], row_of(probe),
                                             work_.mean_layer_light, plan_.measure());
    }

    /// The largest error of the probes that are not in `probes`, which are sorted.
    [[nodiscard]] float worst_error_except(std::span<const uint32_t> probes) const {
        float worst = 0.0f;
        auto next = probes.begin();
        for (uint32_t i = 0; i < work_.accumulators.size(); ++i) {
            if (next != probes.end() && *next == i) {
                ++next;
            } else {
                worst = std::max(worst, work_.accumulators[i].sampling_error(plan_.measure()));
            }
        }
        return worst;
    }

    [[nodiscard]] ProgressReporter::State state_of(const ProbeAccumulator& accumulator,
                                                   float layer_error) const {
        return {plan_.is_done(accumulator, layer_error),
                plan_.is_at_target(accumulator, layer_error)};
    }

    /// True of a round that is expected to end within the time budget, of the first one, without
    /// which a probe would have no light, and of rounds that an earlier run has begun.
    [[nodiscard]] bool has_time_for(uint64_t round, size_t probe_count) const {
        if (settings_.time_budget_seconds == 0.0 || round == 0) return true;
        const auto has_begun = [&](const auto& sums) { return sums.round_count > round; };
        if (std::ranges::any_of(work_.accumulators, has_begun)) return true;
        const auto now = Clock::now();
        const double sampling = std::chrono::duration<double>(now - sampling_start_).count();
        const double seconds_a_sample =
            sampled_count_ > 0 ? sampling / static_cast<double>(sampled_count_) : 0.0;
        const auto samples = static_cast<double>(probe_count * plan_.samples_in_round(round));
        return std::chrono::duration<double>(now - start_).count() + samples * seconds_a_sample <=
               settings_.time_budget_seconds;
    }

    const Work work_;
    const BakeSettings& settings_;
    const RoundPlan plan_;
    const LightGroupLayout layout_;
    const BakeHooks& hooks_;
    ProgressReporter progress_;
    const Clock::time_point start_ = Clock::now();
    Clock::time_point sampling_start_ = start_;
    uint64_t sampled_count_ = 0;  ///< of this run
    Periodic save_{hooks_.save, hooks_.save_seconds, 20};
    Periodic preview_{hooks_.preview, hooks_.preview_seconds, 50};
};

}  // namespace

Status bake_accumulators(const Scene& scene, const BakePlaces& places, const BakeSettings& settings,
                         std::span<ProbeAccumulator> accumulators, const BakeHooks& hooks,
                         const LightGroupRows& light_groups) {
    const std::span positions = places.positions;
    TETRALIGHT_ASSERT(accumulators.size() == positions.size(), "one accumulator for each position");
    const LightGroupLayout layout(settings.plan);
    TETRALIGHT_ASSERT(light_groups.rows.size() == layout.size() * positions.size(),
                      "one row for each position if the plan has light groups");
    TETRALIGHT_ASSERT(
        !layout.has_occlusion || light_groups.occlusion_lights.size() == positions.size(),
        "the occlusion lights of each position");
    TETRALIGHT_ASSERT(
        places.surfaces.texels.empty() || places.surfaces.texels.size() == positions.size(),
        "no surfaces, or one for each position");
    TETRALIGHT_ASSERT(!layout.has_ambient_occlusion || !places.surfaces.texels.empty(),
                      "ambient occlusion is of texels");
    if (auto status = RoundPlan::check(settings); !status) return status;
    if (auto status = check_positions(places); !status) return status;
    if (auto status =
            check_bake_memory(estimate_bake_memory(scene, positions.size(), layout.size()));
        !status) {
        return status.error();
    }
    const auto trace_scene = TraceScene::make_static(scene, settings.surfaces);
    if (!trace_scene) return trace_scene.error();
    const PathSettings path_settings{settings.bounces, settings.clamp};
    std::vector<Opening> openings;
    if (path_settings.traces_all_light()) openings = openings_of(scene, *trace_scene);
    const PathTracer tracer(scene, *trace_scene, path_settings, settings.plan, std::move(openings),
                            places.surfaces.cache);
    std::vector<Light> lights;
    for (const Light& light : scene.lights) lights.push_back(trace_scene->render_from_world(light));
    std::vector<double> mean_light;
    if (settings.target_layer_error > 0.0 && layout.variance_count() > 0) {
        mean_light = mean_layer_light(scene, tracer, settings.seed, settings.thread_count);
        if (places.measure() == ErrorMeasure::OwnNormal) {
            // From the sum over all normals to one of them.
            for (double& light : mean_light) light /= std::sqrt(4.0 * std::numbers::pi);
        }
    }
    const Work work{*trace_scene,         tracer,       places,
                    accumulators,         light_groups, std::move(lights),
                    std::move(mean_light)};
    const auto status = AccumulatorBaker(work, settings, hooks).run();
    return status ? check_light(places, accumulators) : status;
}

}  // namespace tetralight
