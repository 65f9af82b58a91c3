// SPDX-License-Identifier: Apache-2.0
// Time to an error of 1 %. Errors fall with the square root of the samples, so that the time
// follows from a fixed number of samples. The set-up of a tracer does not grow with the samples: it
// is timed apart and spread over the probes.
#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/bake_errors.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/plain_tracer.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kSamples = 1024;
constexpr double kTarget = 0.01;

/// Probes with less of the mean light are left out: their light is hardly known.
constexpr double kLeastLight = 1e-3;

/// A path tracer of the baker and the seconds that it took until it was ready.
class Baker {
  public:
    Baker(const BakeSubject& subject, const TraceScene& scene) : scene_(scene) {
        std::vector<double> times;
        for (int i = 0; i < 3; ++i) {
            times.push_back(cpu_seconds([&] {
                tracer_.emplace(subject.scene, scene, PathSettings{}, LightPlan{},
                                openings_of(subject.scene, scene));
            }));
        }
        set_up_seconds_ = std::ranges::min(times);
    }

    [[nodiscard]] double set_up_seconds() const { return set_up_seconds_; }

    /// Eight independent estimates, as in a bake.
    [[nodiscard]] RadianceSh estimate(const glm::dvec3& probe, uint64_t seed,
                                      uint32_t sample_count) const {
        constexpr uint32_t kSets = 8;
        const DirectionSet directions(sample_count / kSets);
        RadianceSh sum;
        for (uint64_t set = 0; set < kSets; ++set) {
            const uint64_t key = probe_key(kSets * seed + set, probe);
            const glm::vec3 origin = scene_.render_from_world(probe);
            sum += estimate_probe(*tracer_, origin, key, directions).radiance;
        }
        return (1.0f / kSets) * sum;
    }

  private:
    const TraceScene& scene_;
    std::optional<PathTracer> tracer_;
    double set_up_seconds_ = 0.0;
};

/// Seconds until the error is 1 %, by probe.
struct Times {
    std::vector<double> ours, plain;
};

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

class TimeContest {
  public:
    TimeContest(const BakeSubject& subject, const Options& options)
        : subject_(subject),
          seeds_(options.is_quick ? 16 : 64),
          scene_(*TraceScene::make_static(subject.scene)),
          ours_(subject, scene_),
          plain_(subject.scene, scene_) {
        find_references(options.is_quick ? 1u << 17 : 1u << 20);
    }

    void measure() {
        const Times times = all_times();
        report_contest("bake.time_to_1_percent." + subject_.name, 1.0 / mean(times.ours),
                       1.0 / mean(times.plain), "probes/s", "plain path tracer");
        report_contest("bake.time_to_1_percent.median." + subject_.name, 1.0 / median(times.ours),
                       1.0 / median(times.plain), "probes/s", "plain path tracer");
        report("bake.set_up." + subject_.name, ours_.set_up_seconds(), "s");
    }

  private:
    struct Reference {
        glm::dvec3 probe;
        RadianceSh light;
    };

    /// The probes that receive enough light.
    void find_references(uint32_t sample_count) {
        std::vector<Reference> all(subject_.probes.size());
        parallel_for(all.size(), 0, [&](size_t i) {
            const glm::dvec3& probe = subject_.probes[i];
            all[i] = {probe, ours_.estimate(probe, 1000, sample_count)};
        });
        double mean_light = 0.0;
        for (const Reference& reference : all) {
            mean_light += mean_irradiance(reference.light) / static_cast<double>(all.size());
        }
        require(mean_light > 0.0, "light at the probes of " + subject_.name);
        std::ranges::copy_if(all, std::back_inserter(references_), [&](const Reference& r) {
            return mean_irradiance(r.light) >= kLeastLight * mean_light;
        });
    }

    Times all_times() {
        const auto probes = static_cast<double>(subject_.probes.size());
        Times times;
        // One thread, with the processor modes of a bake.
        parallel_for(1, 1, [&](size_t) {
            for (const Reference& reference : references_) add_times(reference, times);
        });
        for (double& seconds : times.ours) seconds += ours_.set_up_seconds() / probes;
        return times;
    }

    /// The contestants take turns in being the first, as the later one finds the scene in cache.
    void add_times(const Reference& reference, Times& times) {
        const glm::vec3 origin = scene_.render_from_world(reference.probe);
        const std::array<std::function<RadianceSh(uint64_t)>, 2> estimates{
            [&](uint64_t seed) { return ours_.estimate(reference.probe, seed, kSamples); },
            [&](uint64_t seed) { return plain_.gather(origin, kSamples, seed); }};
        const std::array<std::vector<double>*, 2> all{&times.ours, &times.plain};
        const size_t first = times.ours.size();
        for (size_t i = 0; i < all.size(); ++i) {
            const size_t turn = (first + i) % all.size();
            all[turn]->push_back(time(reference.light, estimates[turn]));
        }
    }

    [[nodiscard]] double time(const RadianceSh& exact,
                              const std::function<RadianceSh(uint64_t)>& estimate) const {
        std::vector<RadianceSh> lights;
        const double seconds = cpu_seconds([&] {
            for (uint64_t seed = 1; seed <= seeds_; ++seed) lights.push_back(estimate(seed));
        });
        double squares = 0.0;
        for (const RadianceSh& light : lights) {
            const double error = relative_rmse(light, exact) / kTarget;
            squares += error * error;
        }
        return seconds * squares / static_cast<double>(seeds_ * seeds_);
    }

    const BakeSubject& subject_;
    uint64_t seeds_;
    TraceScene scene_;
    Baker ours_;
    PlainTracer plain_;
    std::vector<Reference> references_;
};

}  // namespace

void bench_bake_time(const BakeSubject& subject, const Options& options) {
    TimeContest(subject, options).measure();
}

}  // namespace tetralight::bench
