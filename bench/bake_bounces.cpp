// SPDX-License-Identifier: Apache-2.0
// The default number of bounces against 4.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/bake_errors.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/scene_parts.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kFew = 4;
constexpr size_t kProbes = 16;
constexpr uint32_t kSamples = 1024;

/// Bakes of some probes with one number of bounces.
struct Bounced {
    std::vector<double> light;  ///< mean irradiance of each probe
    double seconds = 0.0;       ///< of processor time until the error is 1 %, mean over the probes
};

Bounced trace(const BakeSubject& subject, uint32_t bounces, uint32_t seeds) {
    const TraceScene scene = *TraceScene::make_static(subject.scene);
    const PathTracer tracer(subject.scene, scene, {.bounces = bounces}, {},
                            openings_of(subject.scene, scene));
    const DirectionSet directions(kSamples);
    const size_t probes = std::min(kProbes, subject.probes.size());
    std::vector<RadianceSh> light(probes * seeds);
    const auto estimate = [&](size_t i) {
        const glm::dvec3& probe = subject.probes[i / seeds];
        const uint64_t key = probe_key(i % seeds, probe);
        light[i] = estimate_probe(tracer, scene.render_from_world(probe), key, directions).radiance;
    };
    const double seconds = cpu_seconds([&] { parallel_for(light.size(), 0, estimate); });
    Bounced bounced;
    for (size_t probe = 0; probe < probes; ++probe) {
        RadianceSh mean;
        for (size_t i = 0; i < seeds; ++i)
            mean += (1.0f / static_cast<float>(seeds)) * light[probe * seeds + i];
        double squares = 0.0;
        for (size_t i = 0; i < seeds; ++i) {
            const double error = relative_rmse(light[probe * seeds + i], mean) / 0.01;
            squares += error * error / (seeds - 1);
        }
        bounced.light.push_back(mean_irradiance(mean));
        bounced.seconds += squares * seconds / static_cast<double>(light.size() * probes);
    }
    return bounced;
}

}  // namespace

BakeSubject white_room() {
    constexpr double kWall = 0.2, kOver = 0.1;
    BakeSubject subject{"white_room", {}, {}};
    Material white;
    white.base_color = glm::vec4(glm::vec3(0.9f / 0.96f), 1.0f);  // 4 % are mirrored instead
    white.metallic = 0.0f;
    white.roughness = 0.0f;
    const auto add = [&](const WorldBox& box) { add_mesh(subject.scene, box_mesh(box), white); };
    add({{-kWall, -kWall, -kWall}, {5 + kWall, 0, 4 + kWall}});
    add({{-kWall, 3, -kWall}, {5 + kWall, 3 + kWall, 4 + kWall}});
    add({{-kWall, -kOver, -kWall}, {5 + kWall, 3 + kOver, 0}});
    add({{-kWall, -kOver, 4}, {5 + kWall, 3 + kOver, 4 + kWall}});
    add({{5, -kOver, -kOver}, {5 + kWall, 3 + kOver, 4 + kOver}});
    add({{-kWall, -kOver, -kOver}, {0, 3 + kOver, 1.2}});
    add({{-kWall, -kOver, 2.8}, {0, 3 + kOver, 4 + kOver}});
    add({{-kWall + 0.01, -kOver, 1.1}, {-0.01, 0.9, 2.9}});
    add({{-kWall + 0.01, 2.1, 1.1}, {-0.01, 3 + kOver, 2.9}});
    subject.scene.environment.radiance = glm::vec3(1.0f);
    Light sun;
    sun.intensity = glm::vec3(10.0f);
    sun.direction = glm::normalize(glm::vec3(1.0f, -0.7f, 0.2f));
    subject.scene.lights.push_back(sun);
    subject.scene.light_names.emplace_back("sun");
    for (const glm::dvec3& place : random_positions(kProbes, 5, 1.0)) {
        subject.probes.push_back(glm::dvec3(0.3) + place * glm::dvec3(4.4, 2.4, 3.4));
    }
    return subject;
}

void bench_bake_bounces(const BakeSubject& subject, const Options& options) {
    const uint32_t seeds = options.is_quick ? 16 : 64;
    const Bounced ours = trace(subject, BakeSettings{}.bounces, seeds);
    const Bounced few = trace(subject, kFew, seeds);
    double ratio = 0.0;
    for (size_t i = 0; i < ours.light.size(); ++i) {
        ratio += ours.light[i] / few.light[i] / static_cast<double>(ours.light.size());
    }
    report("bake.bounces." + subject.name, 100.0 * (ratio - 1.0),
           "% more irradiance by default than with 4 bounces");
    report("bake.bounces.seconds." + subject.name, ours.seconds / few.seconds,
           "seconds to the same error, of those with 4 bounces");
}

}  // namespace tetralight::bench
