// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/sampling/mix.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/half.h>
#include <tetralight/bench/lightmap.h>
#include <tetralight/bench/lightmap_texels.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight::bench {
namespace {

/// Mean and variance of the mean of the irradiance of a texel (green), by paths in proportion to
/// the cosine that sample nothing at the texel.
std::pair<double, double> brute_force(const PathTracer& tracer, glm::vec3 position,
                                      const TexelSurface& surface, uint64_t key, uint32_t count) {
    RandomStream random(key, 0x7e);
    double sum = 0.0, squares = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 offset = surface.origins[size_t{i} * surface.origins.size() / count];
        PathStart start{.origin = position + offset};
        start.direction = sample_cosine_hemisphere(surface.normal, random.next2());
        double light =
            std::numbers::pi * double{tracer.trace(start, Sampler(detail::mix(key), i)).radiance.y};
        for (const Light& lamp : tracer.baked_lights()) {
            const LightSample sample = sample_light(lamp, start.origin, random.next2());
            const float cosine = glm::dot(surface.normal, sample.to_light);
            if (cosine > 0.0f && !tracer.occluded(start.origin, sample, random.next()))
                light += double{sample.irradiance.y * cosine};
        }
        sum += light;
        squares += light * light;
    }
    const double mean = sum / count;
    return {mean, (squares / count - mean * mean) / (count - 1)};
}

/// Texels against brute force at the same places and normals: the root mean square of differences
/// in standard errors, which is 1, and the largest.
void bench_brute_force(const Scene& scene, const PreparedLightmaps& prepared,
                       const std::string& name) {
    const ChosenTexels chosen = every_nth(prepared, 64);
    const auto traced = TraceScene::make_static(scene);
    const PathTracer tracer(scene, *traced, {});
    double squares = 0.0, worst = 0.0;
    size_t count = 0;
    BakeSettings settings;
    settings.sample_count = 4096;
    std::vector<ProbeAccumulator> sums(chosen.positions.size());
    const TexelSurfaces surfaces{chosen.surfaces, prepared.texels.origins};
    require(bool(bake_accumulators(scene, {chosen.positions, surfaces}, settings, sums)), "bake");
    for (size_t i = 0; i < sums.size(); ++i) {
        const auto [mean, variance] = brute_force(
            tracer, traced->render_from_world(chosen.positions[i]), surfaces[i], i + 1, 1u << 16);
        const auto [ours, error] = green_light(sums[i]);
        const double spread = variance + error * error;
        if (!(spread > 0.0)) continue;
        const double z = std::abs(ours - mean) / std::sqrt(spread);
        squares += z * z;
        worst = std::max(worst, z);
        ++count;
    }
    report("lightmap.texel." + name, std::sqrt(squares / static_cast<double>(count)),
           "standard errors, RMS");
    report("lightmap.texel_worst." + name, worst, "standard errors");
}

/// Rays a second of texels against those of probes at the same places.
void bench_rays(const Scene& scene, const PreparedLightmaps& prepared, const std::string& name,
                const Options& options) {
    const ChosenTexels chosen = every_nth(prepared, 2000);
    BakeSettings settings;
    settings.sample_count = 256;
    const auto bake = [&](const BakePlaces& places) {
        std::vector<ProbeAccumulator> sums(places.positions.size());
        const double time = seconds(
            [&] { require(bool(bake_accumulators(scene, places, settings, sums)), "bake"); });
        double rays = 0.0;
        for (const ProbeAccumulator& sum : sums) rays += static_cast<double>(sum.ray_count);
        return time / rays;
    };
    std::vector<glm::dvec3> in_front;
    for (size_t i = 0; i < chosen.positions.size(); ++i)
        in_front.push_back(chosen.positions[i] + 0.01 * glm::dvec3(chosen.surfaces[i].normal));
    Contest contest;
    contest.figure = "lightmap.rays." + name;
    contest.unit = "Mrays/s";
    contest.baseline_is = "probes a centimetre in front of the texels";
    contest.work = 1e-6;
    contest.ours = [&] {
        return bake({chosen.positions, {chosen.surfaces, prepared.texels.origins}});
    };
    contest.baseline = [&] { return bake({in_front}); };
    run(contest, options);
}

}  // namespace

void bench_lightmap_texels(const Scene& scene, const std::string& name, const Options& options) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = 4.0;
    settings.layout.page_size = 2048;
    settings.bake.sample_count = 128;
    auto prepared = prepare_lightmaps(scene, settings);
    require(bool(prepared), "the scene has texels");
    bench_brute_force(scene, *prepared, name);
    bench_rays(scene, *prepared, name, options);
    const auto bake = bake_texels(scene, *prepared);
    require(bool(bake), "bake");
    const BakedLightmaps baked = finish_lightmaps(std::move(*prepared), *bake);
    const double before = double{baked.report.seam_difference_baked};
    const double after = double{baked.report.seam_difference};
    report("lightmap.seams." + name, after, "relative difference, p99");
    if (before > 0.0) report("lightmap.stitched." + name, after / before, "stitched / as baked");
}

void bench_dark_room() {
    Scene scene;
    Material white;
    white.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    white.metallic = 0.0f;
    scene.materials.push_back(white);
    // A shell of 10 cm that stands in the ground: outer and inner box, and the ground.
    const auto add_box = [&](glm::vec3 low, glm::vec3 high, bool is_room) {
        Mesh mesh;
        for (uint32_t i = 0; i < 8; ++i) {
            mesh.positions.emplace_back(i & 1u ? high.x : low.x, i & 2u ? high.y : low.y,
                                        i & 4u ? high.z : low.z);
        }
        mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
        if (is_room) std::ranges::reverse(mesh.indices);
        mesh.material = 0;
        scene.instances.push_back({});
        scene.instances.back().mesh = static_cast<uint32_t>(scene.meshes.size());
        scene.meshes.push_back(std::move(mesh));
    };
    add_box({-2.1f, -0.3f, -2.1f}, {2.1f, 2.6f, 2.1f}, false);
    add_box({-2.0f, -0.2f, -2.0f}, {2.0f, 2.5f, 2.0f}, true);
    add_box({-8, -1, -8}, {8, 0, 8}, false);
    Light sun;
    sun.type = LightType::Directional;
    sun.mode = LightMode::Baked;
    sun.direction = glm::normalize(glm::vec3(0.4f, -1.0f, 0.3f));
    sun.intensity = glm::vec3(100000.0f);
    scene.lights.push_back(sun);
    scene.light_names.emplace_back("sun");
    BakeLightmapsSettings settings;
    settings.bake.sample_count = 256;
    const auto baked = bake_lightmaps(scene, settings);
    require(bool(baked), "bake");
    const LightmapsView maps = baked->lightmaps.view();
    const auto brightest = [&](const LightmapRectangle& place) {
        float light = 0.0f;
        for (uint32_t y = place.y; y < place.y + place.height; ++y) {
            for (uint32_t x = place.x; x < place.x + place.width; ++x) {
                const size_t row = size_t{place.page} * maps.info.page_size + y;
                const auto& texel = maps.irradiance[row * maps.info.page_size + x];
                light = std::max(light, float_from_half(texel.rgb[1]));
            }
        }
        return double{light};
    };
    report("lightmap.dark_room", brightest(maps.rectangles[1]) / brightest(maps.rectangles[2]),
           "worst texel inside / brightest outside");
}

void bench_lightmap_samples(const Options& options) {
    Lightmaps maps;
    maps.info.page_size = 8192;
    maps.info.page_count = 2;
    maps.irradiance.resize(maps.view().texel_count());
    std::mt19937_64 engine(7);
    for (IrradianceTexel& texel : maps.irradiance)
        texel = {{half_from_float(0.1f), half_from_float(0.2f), half_from_float(0.3f)}, kCovered};
    constexpr size_t kCount = 1'000'000;
    std::vector<uint32_t> pages(kCount);
    std::vector<glm::vec2> uvs(kCount);
    std::vector<size_t> texels(kCount);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (size_t i = 0; i < kCount; ++i) {
        pages[i] = static_cast<uint32_t>(engine() % 2);
        uvs[i] = {uniform(engine), uniform(engine)};
        const auto x = static_cast<size_t>(uvs[i].x * 8190.0f);
        const auto y = static_cast<size_t>(uvs[i].y * 8190.0f);
        texels[i] = (pages[i] * size_t{8192} + y) * 8192 + x;
    }
    const LightmapsView view = maps.view();
    std::vector<glm::vec3> answers(kCount);
    uint64_t sink = 0;
    Contest contest;
    contest.figure = "lightmap.sample";
    contest.unit = "Msamples/s";
    contest.baseline_is = "reading the texels of both rows of each sample, and adding them";
    contest.work = static_cast<double>(kCount) * 1e-6;
    contest.ours = [&] { return seconds([&] { sample_irradiance(view, pages, uvs, answers); }); };
    contest.baseline = [&] {
        return seconds([&] {
            for (const size_t i : texels) {
                for (const size_t k : {i, i + 1, i + 8192, i + 8193})
                    sink += view.irradiance[k].rgb[0];
            }
        });
    };
    run(contest, options);
    require(std::abs(answers[0].x - 0.1f) < 1e-3f && sink > 0, "samples");
}

}  // namespace tetralight::bench
