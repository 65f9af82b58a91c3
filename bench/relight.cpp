// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <thread>

#include <tetralight/bake/project_environment.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/harness.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/probes/relight.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kThreads = 2;

/// A `parallel_for` on `kThreads` existing threads, as engines have.
template <class Task>
void on_threads(size_t count, const Task& task) {
    std::vector<std::thread> threads;
    for (size_t t = 0; t < kThreads; ++t) {
        threads.emplace_back([&, t] {
            for (size_t i = t * count / kThreads; i < (t + 1) * count / kThreads; ++i) task(i);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

IrradianceSh some_light(size_t seed) {
    IrradianceSh light;
    for (glm::vec3& c : light.coefficients) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        c = glm::vec3(static_cast<float>(seed >> 40) * 0x1p-24f);
    }
    return light;
}

/// Layers over probes, without cells.
ProbeVolume layered(size_t probe_count, size_t layer_count) {
    ProbeVolume volume;
    volume.positions.resize(probe_count);
    volume.irradiance.resize(probe_count);
    volume.layers.resize(layer_count);
    for (size_t k = 0; k < layer_count; ++k) {
        volume.layer_names += "light:" + std::to_string(k) + "\n";
        volume.layers[k].largest = 1.0f;
    }
    for (size_t i = 0; i < layer_count * probe_count; ++i) {
        volume.layer_irradiance.push_back(some_light(i));
    }
    make_compact_probes(volume);
    return volume;
}

/// Against copying the same number of bytes on the same number of threads.
void recombination(const Options& options) {
    constexpr size_t kProbes = 100'000, kLayers = 4;
    ProbeVolume volume = layered(kProbes, kLayers);
    const std::vector<float> weights{1.0f, 0.5f, 0.25f, 2.0f};
    const size_t read = volume.layer_irradiance.size() * sizeof(IrradianceSh);
    const size_t written = kProbes * (sizeof(IrradianceSh) + sizeof(CompactProbe));
    std::vector<char> from((read + written) / 2, 1), to(from.size());

    Contest contest;
    contest.figure = "relight.recombine.100k";
    contest.unit = "GB/s";
    contest.baseline_is = "memcpy of as many bytes read and written";
    contest.work = static_cast<double>(read + written) / 1e9;
    contest.ours = [&] {
        return seconds([&] {
            require(
                bool(recombine(volume, weights,
                               [](size_t count, const auto& task) { on_threads(count, task); })),
                "recombine");
        });
    };
    contest.baseline = [&] {
        return seconds([&] {
            on_threads(kThreads, [&](size_t i) {
                const size_t begin = i * from.size() / kThreads;
                const size_t end = (i + 1) * from.size() / kThreads;
                std::memcpy(to.data() + begin, from.data() + begin, end - begin);
            });
        });
    };
    run(contest, options);
    IrradianceSh sum = weights[0] * volume.layer_irradiance[7];
    for (size_t k = 1; k < kLayers; ++k)
        sum += weights[k] * volume.layer_irradiance[k * kProbes + 7];
    require(volume.irradiance[7] == sum, "a recombined probe");
}

/// A subject's probes, scene and bake.
struct Bakes {
    const BakeSubject& subject;
    BakeVolumeSettings settings{};

    [[nodiscard]] ProbeVolume bake(const Scene& scene, std::vector<std::string> layers) const {
        BakeVolumeSettings own = settings;
        own.lighting.layers = std::move(layers);
        auto baked = bake_volume(scene, std::vector{make_group("probes", subject.probes)}, own);
        require(bool(baked), "bake");
        return std::move(baked->volume);
    }
};

struct Error {
    double difference = 0.0;
    double light = 0.0;

    void add(const IrradianceSh& found, const IrradianceSh& expected) {
        for (size_t i = 0; i < found.coefficients.size(); ++i) {
            const glm::dvec3 d(found.coefficients[i] - expected.coefficients[i]);
            const glm::dvec3 e(expected.coefficients[i]);
            difference += glm::dot(d, d);
            light += glm::dot(e, e);
        }
    }

    [[nodiscard]] bool is_lit() const { return light > 0.0; }

    [[nodiscard]] double relative() const { return std::sqrt(difference / light); }
};

/// A sky of 64 x 32 texels, by direction.
template <class Radiance>
Environment sky_of(Radiance radiance) {
    Environment sky;
    sky.radiance = glm::vec3(1.0f);
    sky.image = {64, 32, {}};
    for (uint32_t row = 0; row < 32; ++row) {
        for (uint32_t column = 0; column < 64; ++column) {
            const float polar =
                std::numbers::pi_v<float> * (static_cast<float>(row) + 0.5f) / 32.0f;
            const float turn = (static_cast<float>(column) + 0.5f) / 32.0f - 1.0f;
            const float azimuth = std::numbers::pi_v<float> * turn;
            sky.image.pixels.push_back(
                radiance(glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                   std::sin(polar) * std::sin(azimuth))));
        }
    }
    return sky;
}

/// A dusk sky: brighter towards the horizon, warm on one side.
Environment smooth_sky() {
    return sky_of([](glm::vec3 d) {
        const float warm = std::exp(2.0f * (d.x - 1.0f));
        const float high = 0.5f + 0.5f * d.y;
        return glm::vec3(0.3f + 1.5f * warm, 0.4f + 0.7f * warm, 0.9f - 0.4f * high);
    });
}

/// Error of irradiance after relighting against a new bake, root mean square over probes and
/// normals, without closed rooms, which no sky light reaches.
void transfer(const BakeSubject& subject, bool is_quick) {
    Bakes bakes{subject};
    bakes.settings.bake.sample_count = is_quick ? 1024 : 8192;
    Scene dark = subject.scene;
    dark.lights.clear();
    dark.light_names.clear();
    for (Material& material : dark.materials) material.emission = glm::vec3(0.0f);
    if (dark.environment.radiance == glm::vec3(0.0f)) dark.environment.radiance = glm::vec3(1.0f);
    const ProbeVolume baked = bakes.bake(dark, {"transfer"});

    ProbeVolume relit = baked;
    Scene fresh = dark;
    fresh.environment = smooth_sky();
    require(bool(relight_sky(relit, project_sky(fresh.environment))), "relight");
    const ProbeVolume expected = bakes.bake(fresh, {});
    Error smooth;
    for (size_t i = 0; i < expected.irradiance.size(); ++i) {
        smooth.add(relit.irradiance[i], expected.irradiance[i]);
    }
    if (!smooth.is_lit()) return;
    report("relight.transfer.smooth." + subject.name, 100.0 * smooth.relative(), "%");

    // A baked sun: direct light and bounces through sixteen coefficients.
    relit = baked;
    const glm::vec3 direction = glm::normalize(glm::vec3(-0.4f, -1.0f, -0.3f));
    require(bool(relight_sky(relit, distant_sun(-direction, glm::vec3(3.0f)))), "relight");
    fresh.environment = {};
    fresh.lights.resize(1);
    fresh.light_names = {"sun"};
    fresh.lights[0].mode = LightMode::Baked;
    fresh.lights[0].direction = direction;
    fresh.lights[0].intensity = glm::vec3(3.0f);
    const ProbeVolume sunny = bakes.bake(fresh, {});
    Error sun;
    for (size_t i = 0; i < sunny.irradiance.size(); ++i) {
        sun.add(relit.irradiance[i], sunny.irradiance[i]);
    }
    report("relight.transfer.sun." + subject.name, 100.0 * sun.relative(), "%");
}

/// Recombined layers against new bakes of the dimmed scene, in standard errors of the difference.
void layers_error(const BakeSubject& subject) {
    Bakes bakes{subject};
    ProbeVolume layered = bakes.bake(subject.scene, {"sun", "sky", "emission"});
    const std::vector<LayerWeight> changes{{"sun", 0.5f}, {"sky", 0.7f}, {"emission", 2.0f}};
    const auto weights = layer_weights(layered.view(), changes);
    require(weights && recombine(layered, *weights), "recombine");
    Scene dimmed = subject.scene;
    for (Light& light : dimmed.lights) {
        if (light.type == LightType::Directional) light.intensity *= 0.5f;
    }
    dimmed.environment.radiance *= 0.7f;
    for (Material& material : dimmed.materials) material.emission *= 2.0f;
    bakes.settings.bake.seed = 1;
    const ProbeVolume fresh = bakes.bake(dimmed, {});
    std::vector<double> sigmas;
    for (size_t i = 0; i < fresh.irradiance.size(); ++i) {
        Error error;
        error.add(layered.irradiance[i], fresh.irradiance[i]);
        const double sigma =
            std::numbers::sqrt2 * static_cast<double>(fresh.health[i].standard_error);
        if (sigma > 0.0) sigmas.push_back(error.relative() / sigma);
    }
    const auto within = std::ranges::count_if(sigmas, [](double sigma) { return sigma <= 2.0; });
    report("relight.layers_error." + subject.name, median(sigmas), "standard errors (median)");
    report("relight.layers_within." + subject.name,
           100.0 * static_cast<double>(within) / static_cast<double>(sigmas.size()),
           "% of probes within two standard errors");
}

/// Time of a bake with additional outputs, relative to a plain one.
void cost(const std::string& figure, const BakeSubject& subject, const LightingSettings& lighting,
          const Scene& scene, const Options& options) {
    BakeVolumeSettings plain, more;
    more.lighting = lighting;
    const std::vector groups{make_group("probes", subject.probes)};
    const auto bake = [&](const BakeVolumeSettings& settings) {
        return seconds([&] { require(bool(bake_volume(scene, groups, settings)), "bake"); });
    };
    std::vector<double> ratios;
    for (int i = 0; i < options.repetitions; ++i) {
        const double baseline = bake(plain);
        ratios.push_back(bake(more) / baseline);
    }
    report(figure + "." + subject.name, median(ratios), "times the plain bake");
}

/// The scene with four mixed point lights of radius 10 cm among its probes.
Scene with_four_lamps(const BakeSubject& subject) {
    Scene scene = subject.scene;
    scene.lights.clear();
    scene.light_names.clear();
    for (size_t i = 0; i < 4; ++i) {
        Light& lamp = scene.lights.emplace_back();
        lamp.type = LightType::Point;
        lamp.intensity = glm::vec3(5.0f);
        lamp.position = glm::vec3(subject.probes[i * (subject.probes.size() - 1) / 3]);
        lamp.position.y += 0.3f;
        lamp.radius = 0.1f;
        scene.light_names.push_back("lamp " + std::to_string(i));
    }
    return scene;
}

}  // namespace

void bench_relight(const Options& options) {
    recombination(options);
    for (const BakeSubject& subject : bake_subjects(options)) {
        transfer(subject, options.is_quick);
        layers_error(subject);
        const std::vector<std::string> four{"sun", "sky", "emission"};  // and the layer `rest`
        cost("relight.layers_cost", subject, {MixedLighting::Indirect, four}, subject.scene,
             options);
        cost("relight.transfer_cost", subject, {MixedLighting::Indirect, {"transfer"}},
             subject.scene, options);
        cost("relight.occlusion_cost", subject, {MixedLighting::Shadowmask, {}},
             with_four_lamps(subject), options);
    }
}

}  // namespace tetralight::bench
