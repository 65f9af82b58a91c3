// SPDX-License-Identifier: Apache-2.0
// Errors over the number of traced rays, for bench/plot_convergence.py.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/direction_set.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/bake_errors.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/plain_tracer.h>

namespace tetralight::bench {
namespace {

constexpr size_t kProbes = 16;
constexpr uint64_t kTrials = 8;
constexpr uint32_t kFewest = 64, kMost = 65536;
constexpr uint32_t kReference = 1u << 20;

class Convergence {
  public:
    Convergence(const BakeSubject& subject, std::ostream& csv)
        : subject_(subject),
          scene_(*TraceScene::make_static(subject.scene)),
          tracer_(subject.scene, scene_, {}, {}, openings_of(subject.scene, scene_)),
          without_openings_(subject.scene, scene_, {}),
          csv_(csv) {
        scene_.listen(
            {[](void* rays, const Ray&, RayKind, float) { ++*static_cast<uint64_t*>(rays); },
             &rays_});
    }

    void write() {
        for (size_t i = 0; i < std::min(kProbes, subject_.probes.size()); ++i) {
            const RadianceSh light = ours(tracer_, subject_.probes[i], kTrials, kReference);
            if (light == RadianceSh{}) continue;
            probes_.push_back(subject_.probes[i]);
            references_.push_back(light);
        }
        for (uint32_t n = kFewest; n <= kMost; n *= 4) {
            write_line("ours", [&](const glm::dvec3& probe, uint64_t trial) {
                return ours(tracer_, probe, trial, n);
            });
            if (!tracer_.openings().is_empty()) {
                write_line("without openings", [&](const glm::dvec3& probe, uint64_t trial) {
                    return ours(without_openings_, probe, trial, n);
                });
            }
            PlainTracer plain(subject_.scene, scene_);
            write_line("random", [&](const glm::dvec3& probe, uint64_t trial) {
                return plain.gather(scene_.render_from_world(probe), n, trial);
            });
        }
    }

  private:
    [[nodiscard]] RadianceSh ours(const PathTracer& tracer, const glm::dvec3& probe, uint64_t trial,
                                  uint32_t n) const {
        constexpr uint32_t kSets = 8;
        const DirectionSet directions(n / kSets);
        RadianceSh sum;
        for (uint64_t set = 0; set < kSets; ++set) {
            const uint64_t key = probe_key(kSets * trial + set, probe);
            sum +=
                estimate_probe(tracer, scene_.render_from_world(probe), key, directions).radiance;
        }
        return (1.0f / kSets) * sum;
    }

    /// The median over probes of the root mean square over trials.
    template <class Gather>
    void write_line(const char* method, Gather gather) {
        rays_ = 0;
        std::vector<double> errors;
        for (size_t i = 0; i < probes_.size(); ++i) {
            double squares = 0.0;
            for (uint64_t trial = 0; trial < kTrials; ++trial) {
                const double error = relative_rmse(gather(probes_[i], trial), references_[i]);
                squares += error * error / kTrials;
            }
            errors.push_back(std::sqrt(squares));
        }
        const auto gathered = static_cast<double>(kTrials * probes_.size());
        csv_ << subject_.name << ',' << method << ',' << static_cast<double>(rays_) / gathered
             << ',' << median(errors) << std::endl;
    }

    const BakeSubject& subject_;
    TraceScene scene_;
    PathTracer tracer_, without_openings_;
    std::ostream& csv_;
    uint64_t rays_ = 0;
    std::vector<glm::dvec3> probes_;
    std::vector<RadianceSh> references_;
};

/// The darkest quarter of the probes.
BakeSubject darkest(const std::string& name, const BakeSubject& subject) {
    BakeSettings settings;
    settings.sample_count = 8192;
    const auto baked = bake_probes(subject.scene, subject.probes, settings);
    require(bool(baked), "bake");
    std::vector<std::pair<double, size_t>> order;
    for (size_t i = 0; i < subject.probes.size(); ++i) {
        order.emplace_back(mean_irradiance(baked->radiance[i]), i);
    }
    std::ranges::sort(order);
    BakeSubject dark{name, subject.scene, {}};
    for (size_t i = 0; i < order.size() / 4; ++i) {
        dark.probes.push_back(subject.probes[order[i].second]);
    }
    return dark;
}

}  // namespace

void write_convergence(const std::string& path, const Options& options) {
    std::ofstream csv(path);
    require(bool(csv), path + ": cannot be written");
    csv << "scene,method,rays,error\n";
    const auto write = [&](const BakeSubject& subject) {
        // One thread counts rays, under the processor modes of a bake.
        parallel_for(1, 1, [&](size_t) { Convergence(subject, csv).write(); });
    };
    for (const BakeSubject& subject : bake_subjects(options)) {
        write(subject);
        if (subject.name == "scene") write(darkest("halls", subject));
    }
    for (const RoomLight light : {RoomLight::Sun, RoomLight::SkyOnly}) {
        if (is_selected(options, rooms_name(light))) write(rooms_subject(light));
    }
}

}  // namespace tetralight::bench
