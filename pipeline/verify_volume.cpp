// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/verify_volume.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/all_bounces.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/sampling/mix.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/baked_sum.h>
#include <tetralight/pipeline/free_places.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/override_probes.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/verify/verify_checks.h>

namespace tetralight {
namespace {

/// Positions that are drawn at most for each place.
constexpr uint32_t kMostDrawsOfAPlace = 100;

Error volume_error(const std::string& reason) {
    return {ErrorCode::InvalidArgument, "volume", "", reason};
}

Status check_settings(const VerifySettings& settings) {
    if (settings.probe_count > 0 || settings.place_count > 0) return Ok{};
    return Error{ErrorCode::InvalidArgument, "probes", "0",
                 "probes and places are both 0: there is nothing to compare"};
}

Status check_volume(const ProbeVolumeView& volume) {
    if (volume.positions.empty()) return volume_error("the volume has no probes");
    if (volume.irradiance.empty() && volume.compact.empty()) {
        return volume_error("the volume holds no light (it was not baked)");
    }
    if (was_relit(volume.metadata)) {
        return volume_error("the volume was relit: its light is not that of the scene");
    }
    return Ok{};
}

/// The world position from which the bake sampled the light of a probe.
glm::dvec3 capture_position(const ProbeVolumeView& volume, uint32_t probe) {
    const glm::dvec3 position = volume.exact_positions.empty()
                                    ? volume.info.world_origin + glm::dvec3(volume.positions[probe])
                                    : volume.exact_positions[probe];
    if (volume.health.empty()) return position;
    return position + glm::dvec3(volume.health[probe].virtual_offset);
}

/// Irradiance of each channel: root mean square over all normals.
glm::dvec3 rms_irradiance(const IrradianceSh& irradiance) {
    glm::dvec3 squares(0.0);
    for (const glm::vec3& coefficient : irradiance.coefficients) {
        squares += glm::dvec3(coefficient) * glm::dvec3(coefficient);
    }
    return glm::sqrt(squares / (4.0 * std::numbers::pi));
}

/// The light of one probe. Its stored error is relative to the irradiance over all normals.
VerifyProbe make_verify_probe(const ProbeVolumeView& volume, uint32_t probe) {
    VerifyProbe made;
    made.probe = probe;
    made.position = capture_position(volume, probe);
    made.irradiance = volume.irradiance[probe];
    made.volume = mean_over_normals(made.irradiance);
    if (volume.health.empty()) return made;
    made.volume_error =
        double{volume.health[probe].standard_error} * rms_irradiance(made.irradiance);
    return made;
}

class Preparation {
  public:
    Preparation(const Scene& scene, const TraceScene& traced, const ProbeVolumeView& volume,
                const VerifySettings& settings, float min_validity)
        : scene_(scene),
          traced_(traced),
          volume_(volume),
          settings_(settings),
          min_validity_(min_validity),
          eyes_(make_probe_eyes(traced, volume, min_validity, settings.thread_count)) {
        report_.volume_probe_count = volume.probe_count();
    }

    VerifyReport run() {
        choose_probes(comparable_probes());
        if (settings_.place_count > 0) draw_places();
        return std::move(report_);
    }

  private:
    [[nodiscard]] std::vector<ProbeOverride> overrides() const {
        if (volume_.exact_positions.empty()) return {};
        return find_overrides(scene_.probe_adjustments, volume_.exact_positions);
    }

    [[nodiscard]] std::vector<uint32_t> comparable_probes() {
        const std::vector<ProbeOverride> changed = overrides();
        std::vector<uint32_t> probes;
        for (uint32_t i = 0; i < volume_.probe_count(); ++i) {
            if (!volume_.health.empty() && volume_.health[i].is_dilated != 0) {
                ++report_.excluded.dilated;
            } else if (eyes_.is_inside[i] != 0) {
                ++report_.excluded.inside;
            } else if (!changed.empty() && changed[i].intensity != 1.0f) {
                ++report_.excluded.overridden;
            } else {
                probes.push_back(i);
            }
        }
        return probes;
    }

    void choose_probes(const std::vector<uint32_t>& probes) {
        const size_t count = std::min<size_t>(settings_.probe_count, probes.size());
        for (size_t i = 0; i < count; ++i) {
            const size_t begin = i * probes.size() / count;
            const size_t end = (i + 1) * probes.size() / count;
            const uint64_t random = detail::mix(detail::mix(settings_.seed) + i);
            const uint32_t probe = probes[begin + random % (end - begin)];
            report_.probes.push_back(make_verify_probe(volume_, probe));
        }
    }

    void draw_places() {
        const FreePlaces found = find_free_places(traced_, eyes_, volume_,
                                                  {.count = settings_.place_count,
                                                   .clearance = settings_.clearance,
                                                   .seed = settings_.seed,
                                                   .most_draws = kMostDrawsOfAPlace,
                                                   .min_validity = min_validity_,
                                                   .thread_count = settings_.thread_count});
        for (const FreePlace& place : found.places) {
            VerifyPlace made;
            made.position = glm::dvec3(place.position);
            made.is_unseen = place.is_unseen();
            made.is_outside = place.location.cell >= volume_.info.inner_cell_count;
            made.answer = mean_over_normals(interpolate(volume_, place.location).irradiance);
            report_.places.push_back(made);
        }
    }

    const Scene& scene_;
    const TraceScene& traced_;
    const ProbeVolumeView& volume_;
    const VerifySettings& settings_;
    float min_validity_;
    ProbeEyes eyes_;
    VerifyReport report_;
};

/// What the volume differs in from all light of the scene, by its settings.
std::vector<std::string> notes_of(const BakeSettings& baked, uint32_t bounces) {
    std::vector<std::string> notes{
        "The referee shares with the baker the scene, its materials (bake/scene), the rays of "
        "Embree (bake/rays) and the choice of free places; it has a path tracer, a sampler and "
        "light samples of its own."};
    if (baked.bounces < kAllBounces) {
        notes.push_back(str_cat("The bake cut paths after ", baked.bounces,
                                " reflections; the referee ",
                                bounces == baked.bounces ? "does so too." : "has another limit."));
    }
    if (baked.clamp > 0.0f) {
        notes.push_back(str_cat("The bake clamped the light of paths to ", baked.clamp,
                                ", which loses light; the referee does not clamp."));
    }
    return notes;
}

/// One of the positions of a report.
struct Job {
    uint64_t order = 0;
    glm::dvec3 position{0.0};
    TracedLight* light = nullptr;
    bool is_place = false;
};

/// All positions in random order, so that a time limit ends everywhere alike.
std::vector<Job> jobs_of(VerifyReport& report, uint64_t seed) {
    std::vector<Job> jobs;
    const uint64_t key = detail::mix(seed + detail::kGoldenRatio64);
    const auto add = [&](const glm::dvec3& position, TracedLight& light, bool is_place) {
        jobs.push_back({detail::mix(key + jobs.size()), position, &light, is_place});
    };
    for (VerifyProbe& probe : report.probes) add(probe.position, probe.traced, false);
    for (VerifyPlace& place : report.places) add(place.position, place.traced, true);
    std::ranges::sort(jobs, {}, &Job::order);
    return jobs;
}

/// Removes positions without traced light. Returns invalid_argument if no probe remains of those
/// that were chosen, or no place.
Status remove_untraced(VerifyReport& report, double time_limit_seconds) {
    const auto is_untraced = [](const auto& element) { return element.traced.sample_count == 0; };
    const size_t probes = std::erase_if(report.probes, is_untraced);
    const size_t places = std::erase_if(report.places, is_untraced);
    report.untraced_count = probes + places;
    const bool no_probe = probes > 0 && report.probes.empty();
    const bool no_place = places > 0 && report.places.empty();
    if (!no_probe && !no_place) return Ok{};
    const bool is_nothing = report.probes.empty() && report.places.empty();
    const std::string seconds = str_cat(time_limit_seconds);
    return Error{ErrorCode::InvalidArgument, "time_limit", seconds,
                 str_cat("the time limit of ", seconds, " s ended before any ",
                         no_probe ? "probe" : "place", " was traced",
                         is_nothing ? ": nothing was traced and nothing is compared"
                                    : ": the volume cannot be judged")};
}

Status run_jobs(const PlainTracer& tracer, const VerifySettings& settings, std::vector<Job>& jobs,
                const BakeCallback& callback) {
    TraceEffort effort = settings.effort;
    effort.seed = settings.seed;
    TraceEffort place_effort = effort;
    place_effort.target_error *= settings.place_error_factor;
    const Stopwatch clock;
    ProgressReporter progress(callback, jobs.size());
    parallel_for(jobs.size(), settings.thread_count, [&](size_t i) {
        Job& job = jobs[i];
        if (progress.is_cancelled()) return;
        const double limit = settings.time_limit_seconds;
        if (limit > 0.0 && clock.seconds() > limit) return;
        *job.light = trace_light(tracer, job.position, job.is_place ? place_effort : effort);
        const uint64_t samples = job.light->sample_count;
        progress.add_round({.samples = samples,
                            .expected_samples = samples,
                            .is_first = true,
                            .state = {.is_done = true}});
        progress.add_rays(samples);
    });
    if (progress.is_cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    progress.finish();
    return Ok{};
}

}  // namespace

Result<VerifyReport> prepare_verify(const Scene& scene, const ProbeVolumeView& volume,
                                    const VerifySettings& settings) {
    if (auto status = check_settings(settings); !status) return status.error();
    if (auto status = check_volume(volume); !status) return status.error();
    const auto recorded = recorded_settings(volume.metadata);
    if (!recorded) return recorded.error();
    const auto sum = BakedSum::make(volume);
    if (!sum) return sum.error();
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    const ProbeVolumeView baked = sum->view();
    VerifyReport report =
        Preparation(scene, *traced, baked, settings, recorded->health.min_validity).run();
    if (report.probes.empty() && report.places.empty()) {
        return Error{ErrorCode::NotFound, "volume", "",
                     "no probe and no place of the volume is in free space"};
    }
    report.seed = settings.seed;
    report.rules = settings.rules;
    report.bounces = settings.bounces.value_or(recorded->bake.bounces);
    report.notes = notes_of(recorded->bake, report.bounces);
    return report;
}

Status trace_report(const Scene& scene, const ProbeVolumeView& volume,
                    const VerifySettings& settings, VerifyReport& report,
                    const BakeCallback& callback) {
    const auto recorded = recorded_settings(volume.metadata);
    if (!recorded) return recorded.error();
    auto plan = plan_lighting(scene, {recorded->lighting.mixed_lighting, {}});
    if (!plan) return plan.error();
    const auto traced = TraceScene::make_static(scene, recorded->bake.surfaces);
    if (!traced) return traced.error();
    const PlainTracer tracer(scene, *traced, {report.bounces, std::move(plan->bake.light_modes)});
    report.referee = "path tracer";
    std::vector<Job> jobs = jobs_of(report, settings.seed);
    if (auto status = run_jobs(tracer, settings, jobs, callback); !status) return status;
    return remove_untraced(report, settings.time_limit_seconds);
}

void finish_verify(const VerifySettings& settings, VerifyReport& report) {
    summarize(report);
    report.failures = check_limits(report, settings.limits);
}

Result<VerifyReport> verify_volume(const Scene& scene, const ProbeVolumeView& volume,
                                   const VerifySettings& settings, const BakeCallback& callback) {
    auto report = prepare_verify(scene, volume, settings);
    if (!report) return report.error();
    if (auto status = trace_report(scene, volume, settings, *report, callback); !status) {
        return status.error();
    }
    finish_verify(settings, *report);
    return report;
}

}  // namespace tetralight
