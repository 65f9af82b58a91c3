// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/plain_tracer.h>
#include <tetralight/probes/dering.h>
#include <tetralight/probes/sh_minimum.h>

namespace tetralight::bench {
namespace {

/// Normals towards the faces, edges and corners of a cube.
std::vector<glm::vec3> normals() {
    std::vector<glm::vec3> result;
    for (int i = 0; i < 27; ++i) {
        const glm::vec3 n(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (i != 13) result.push_back(glm::normalize(n));
    }
    return result;
}

struct Moments {
    double error = 0.0;  ///< mean square of the difference in irradiance
    double light = 0.0;  ///< mean irradiance
};

Moments compare(const RadianceSh& a, const RadianceSh& reference) {
    static const std::vector<glm::vec3> kNormals = normals();
    const IrradianceSh ea = irradiance_from_radiance(a);
    const IrradianceSh er = irradiance_from_radiance(reference);
    Moments moments;
    const double weight = 1.0 / (3.0 * static_cast<double>(kNormals.size()));
    for (const glm::vec3& n : kNormals) {
        const glm::dvec3 light = evaluate_irradiance(er, n);
        const glm::dvec3 error = glm::dvec3(evaluate_irradiance(ea, n)) - light;
        moments.error += weight * glm::dot(error, error);
        moments.light += weight * (light.x + light.y + light.z);
    }
    return moments;
}

/// The inputs that all estimates share.
struct Traced {
    const BakeSubject& subject;
    TraceScene scene;
    PathTracer tracer;

    explicit Traced(const BakeSubject& from)
        : subject(from),
          scene(*TraceScene::make_static(from.scene)),
          tracer(from.scene, scene, {kBounces}) {}

    /// Eight independent estimates, as in a bake.
    [[nodiscard]] RadianceSh estimate(const glm::dvec3& probe, uint64_t seed,
                                      uint32_t direction_count) const {
        RadianceSh sum;
        const DirectionSet directions(direction_count / 8);
        for (uint64_t set = 0; set < 8; ++set) {
            const uint64_t key = probe_key(8 * seed + set, probe);
            sum += estimate_probe(tracer, scene.render_from_world(probe), key, directions).radiance;
        }
        return 0.125f * sum;
    }
};

/// Seconds until the error of every probe is 1 %, extrapolated from a fixed number of samples: the
/// error falls with the square root of time.
void time_to_1_percent(const Traced& traced, const Options& options) {
    constexpr uint32_t kDirections = 1024;
    const uint32_t reference_directions = options.is_quick ? 16'384 : 131'072;
    PlainTracer plain(traced.subject.scene, traced.scene, kBounces);
    double ours = 0.0, baseline = 0.0;
    for (const glm::dvec3& probe : traced.subject.probes) {
        const RadianceSh reference = traced.estimate(probe, 1000, reference_directions);
        if (compare(reference, reference).light <= 0.0) continue;
        for (uint64_t seed = 0; seed < 4; ++seed) {
            RadianceSh a, b;
            const double a_seconds =
                seconds([&] { a = traced.estimate(probe, seed, kDirections); });
            const double b_seconds = seconds([&] {
                b = plain.gather(traced.scene.render_from_world(probe), kDirections, seed);
            });
            const double a_error = relative_rmse(a, reference) / 0.01;
            const double b_error = relative_rmse(b, reference) / 0.01;
            ours += a_seconds * a_error * a_error;
            baseline += b_seconds * b_error * b_error;
        }
    }
    const double count = 4.0 * static_cast<double>(traced.subject.probes.size());
    report_contest("bake.time_to_1_percent." + traced.subject.name, count / ours, count / baseline,
                   "probes/s", "plain path tracer");
}

/// Root mean square error of irradiance over all normals, relative to that of irradiance: the
/// quantity that error bars predict. Uses Parseval's identity.
double parseval_error(const RadianceSh& a, const RadianceSh& reference) {
    const IrradianceSh light = irradiance_from_radiance(reference);
    const IrradianceSh difference = irradiance_from_radiance(a + -1.0f * reference);
    double error = 0.0, sum = 0.0;
    for (size_t i = 0; i < light.coefficients.size(); ++i) {
        const glm::dvec3 d(difference.coefficients[i]), e(light.coefficients[i]);
        error += glm::dot(d, d);
        sum += glm::dot(e, e);
    }
    return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}

/// A bake with `factor` times as many samples.
BakeSettings longer(BakeSettings settings, uint64_t factor) {
    settings.target_error /= std::sqrt(static_cast<double>(factor));
    settings.max_sample_count *= factor;
    settings.seed = 1000;
    return settings;
}

/// Whole bakes at default settings against one with 64 times as many samples, and their error bars
/// against their errors.
void noise(const BakeSubject& subject, const Options& options) {
    const uint64_t bakes = options.is_quick ? 2 : 8;
    BakeSettings settings = with_default_target({});
    settings.bounces = kBounces;
    const auto reference =
        bake_probes(subject.scene, subject.probes, longer(settings, options.is_quick ? 4 : 64));
    require(bool(reference), "bake");
    std::vector<double> errors, bake_seconds;
    std::vector<double> squares(subject.probes.size()), predicted(subject.probes.size());
    for (settings.seed = 0; settings.seed < bakes; ++settings.seed) {
        auto baked = Result<BakedProbes>(BakedProbes{});
        bake_seconds.push_back(
            seconds([&] { baked = bake_probes(subject.scene, subject.probes, settings); }));
        require(bool(baked), "bake");
        for (size_t i = 0; i < subject.probes.size(); ++i) {
            const RadianceSh& exact = reference->radiance[i];
            errors.push_back(100.0 * relative_rmse(baked->radiance[i], exact));
            const double error = parseval_error(baked->radiance[i], exact);
            squares[i] += error * error;
            predicted[i] +=
                static_cast<double>(baked->standard_error[i]) * baked->standard_error[i];
        }
    }
    std::vector<double> ratios;
    for (size_t i = 0; i < squares.size(); ++i) {
        if (squares[i] > 0.0) ratios.push_back(std::sqrt(predicted[i] / squares[i]));
    }
    std::ranges::sort(errors);
    report("bake.noise.median." + subject.name, median(errors), "%");
    report("bake.noise.p99." + subject.name, errors[(errors.size() - 1) * 99 / 100], "%");
    report("bake.noise.seconds." + subject.name, median(bake_seconds), "s a bake");
    report("bake.error_bar." + subject.name, median(ratios), "predicted / actual");
}

/// The least irradiance after dering, relative to that of band 0, of probes that a baked sun
/// lights.
void dering_min(const BakeSubject& subject) {
    Scene scene = subject.scene;
    for (Light& light : scene.lights) light.mode = LightMode::Baked;
    const auto baked = bake_probes(scene, subject.probes, {});
    require(bool(baked), "bake");
    double least = 1.0;
    for (const RadianceSh& radiance : baked->radiance) {
        const IrradianceSh light =
            dering(irradiance_from_radiance(radiance), DeringWindow::Mildest);
        const glm::dvec3 lowest = minimum_irradiance(light);
        for (int channel = 0; channel < 3; ++channel) {
            const double mean = light.coefficients[0][channel];
            if (mean > 0.0) least = std::min(least, lowest[channel] / mean);
        }
    }
    report("bake.dering_min." + subject.name, least, "of E_00");
}

void threads(const BakeSubject& subject, const Options& options) {
    Contest contest;
    contest.figure = "bake.threads." + subject.name;
    contest.unit = "probes/s";
    contest.baseline_is = "one thread, times two";
    contest.work = static_cast<double>(subject.probes.size());
    const auto bake = [&](uint32_t thread_count) {
        BakeSettings settings;
        settings.sample_count = 16384;  // long compared with building the ray tree on one thread
        settings.thread_count = thread_count;
        return seconds(
            [&] { require(bool(bake_probes(subject.scene, subject.probes, settings)), "bake"); });
    };
    contest.ours = [&] { return bake(2); };
    contest.baseline = [&] { return bake(1) / 2.0; };
    run(contest, options);
}

}  // namespace

double relative_rmse(const RadianceSh& a, const RadianceSh& reference) {
    const Moments moments = compare(a, reference);
    return moments.light > 0.0 ? std::sqrt(moments.error) / moments.light : 0.0;
}

void bench_bake(const Options& options) {
    if (options.convergence) return write_convergence(*options.convergence, options);
    bench_direction_sets();
    bench_bake_validity();
    for (const BakeSubject& subject : bake_subjects(options)) {
        const Traced traced(subject);
        time_to_1_percent(traced, options);
        bench_bake_rays(subject, options);
        noise(subject, options);
        dering_min(subject);
        threads(subject, options);
    }
}

}  // namespace tetralight::bench
