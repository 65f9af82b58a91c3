// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <tetralight/bench/lightmap.h>
#include <tetralight/bench/lightmap_texels.h>

namespace tetralight::bench {
namespace {

struct Sampled {
    std::vector<GreenLight> lights;
    double seconds = 0.0;
    double rays = 0.0;
};

Sampled sample(const Scene& scene, const PreparedLightmaps& prepared, const ChosenTexels& chosen,
               uint32_t sample_count, const RadianceCache* cache) {
    BakeSettings settings = prepared.settings.bake;
    settings.sample_count = sample_count;
    settings.target_error = 0.0;
    TexelSurfaces surfaces{chosen.surfaces, prepared.texels.origins};
    surfaces.cache = cache;
    std::vector<ProbeAccumulator> sums(chosen.positions.size());
    Sampled sampled;
    sampled.seconds = seconds([&] {
        require(bool(bake_accumulators(scene, {chosen.positions, surfaces}, settings, sums)),
                "bake");
    });
    for (const ProbeAccumulator& sum : sums) {
        sampled.lights.push_back(green_light(sum));
        sampled.rays += static_cast<double>(sum.ray_count);
    }
    return sampled;
}

}  // namespace

void bench_lightmap_cache(const Scene& scene, const std::string& name) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = 4.0;
    settings.layout.page_size = 2048;
    const auto prepared = prepare_lightmaps(scene, settings);
    require(bool(prepared), "the scene has texels");
    const auto [cache, cache_seconds_each] = make_timed_cache(scene, *prepared);
    const auto trusted = static_cast<double>(std::ranges::count(cache.is_trusted, true));
    report("lightmap.cache_trusted." + name, trusted / static_cast<double>(prepared->baked.size()),
           "of valid texels");
    report("lightmap.cache_time." + name, 1e6 * cache_seconds_each, "us a texel");
    const ChosenTexels chosen = every_nth(*prepared, 512);
    constexpr uint32_t kSamples = 1u << 14, kMoreSamples = 2;
    const Sampled cached = sample(scene, *prepared, chosen, kSamples, &cache);
    const Sampled exact = sample(scene, *prepared, chosen, kMoreSamples * kSamples, nullptr);
    double sum_cached = 0.0, sum_exact = 0.0, variance = 0.0;
    for (size_t i = 0; i < exact.lights.size(); ++i) {
        sum_cached += cached.lights[i].value;
        sum_exact += exact.lights[i].value;
        variance += std::pow(cached.lights[i].error, 2) + std::pow(exact.lights[i].error, 2);
    }
    const double least = 1e-3 * sum_exact / static_cast<double>(exact.lights.size());
    std::vector<double> differences;
    double cached_noise = 0.0, exact_noise = 0.0;
    for (size_t i = 0; i < exact.lights.size(); ++i) {
        const GreenLight &a = cached.lights[i], &b = exact.lights[i];
        if (b.value < least) continue;
        const double noise = std::hypot(a.error, b.error);
        differences.push_back(std::max(0.0, std::abs(a.value - b.value) - 2.0 * noise) / b.value);
        cached_noise += std::pow(a.error / b.value, 2);
        exact_noise += std::pow(b.error / b.value, 2);
    }
    std::ranges::sort(differences);
    report("lightmap.cache." + name, sum_cached / sum_exact - 1.0, "cached / exact - 1");
    report("lightmap.cache_noise." + name, std::sqrt(variance) / sum_exact, "standard error of it");
    report("lightmap.cache_p99." + name, differences[differences.size() * 99 / 100],
           "relative difference beyond two standard errors");
    report("lightmap.cache_variance." + name, exact_noise / cached_noise * kMoreSamples,
           "relative variance of a sample, exact / cached");
    report("lightmap.cache_speed." + name, exact.seconds / cached.seconds / kMoreSamples,
           "time of a sample, exact / cached");
    report("lightmap.cache_rays." + name, exact.rays / cached.rays / kMoreSamples,
           "rays of a sample, exact / cached");
}

}  // namespace tetralight::bench
