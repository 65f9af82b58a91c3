// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/harness.h>
#include <tetralight/probes/dering.h>
#include <tetralight/probes/sh_minimum.h>

namespace tetralight::bench {
namespace {

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

void threads(const BakeSubject& subject, Options options) {
    options.repetitions = std::min(options.repetitions, 3);
    const std::vector<glm::dvec3> positions = some_probes(subject);
    Contest contest;
    contest.figure = "bake.threads." + subject.name;
    contest.unit = "probes/s";
    contest.baseline_is = "one thread, times two";
    contest.work = static_cast<double>(positions.size());
    const auto bake = [&](uint32_t thread_count) {
        BakeSettings settings;
        settings.sample_count = 16384;  // long compared with building the ray tree on one thread
        settings.thread_count = thread_count;
        return seconds(
            [&] { require(bool(bake_probes(subject.scene, positions, settings)), "bake"); });
    };
    contest.ours = [&] { return bake(2); };
    contest.baseline = [&] { return bake(1) / 2.0; };
    run(contest, options);
}

/// Measures the selected figures of one scene.
void measure(const BakeSubject& subject, const Options& options) {
    const auto wants = [&](const char* figure) {
        return options.figure.value_or(figure) == figure;
    };
    if (wants("time")) bench_bake_time(subject, options);
    if (wants("rays")) bench_bake_rays(subject, options);
    if (wants("noise")) bench_bake_noise(subject, options);
    if (wants("dering")) dering_min(subject);
    if (wants("threads")) threads(subject, options);
    if (wants("layers") && subject.name == "courtyard") bench_bake_layers(subject, options);
    if (wants("bounces") && subject.name == "scene") bench_bake_bounces(subject, options);
}

}  // namespace

void bench_bake(const Options& options) {
    if (options.convergence) return write_convergence(*options.convergence, options);
    if (!options.only && !options.figure) {
        bench_direction_sets();
        bench_bake_validity();
    }
    for (const BakeSubject& subject : bake_subjects(options)) measure(subject, options);
    for (const RoomLight light : {RoomLight::Sun, RoomLight::SkyOnly}) {
        if (is_selected(options, rooms_name(light))) measure(rooms_subject(light), options);
    }
    if (is_selected(options, "white_room") && options.figure.value_or("bounces") == "bounces") {
        bench_bake_bounces(white_room(), options);
    }
}

}  // namespace tetralight::bench
