// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <span>
#include <utility>

#include <tetralight/bench/lightmap.h>
#include <tetralight/bench/lightmap_texels.h>
#include <tetralight/bench/scene_parts.h>
#include <tetralight/pipeline/texel_lights.h>

namespace tetralight::bench {
namespace {

/// Texels with less light, in means of all texels, are left out.
constexpr double kLeastLight = 1e-3;

/// Where a texel lies in the maps.
struct TexelPlace {
    uint32_t instance = 0;
    uint32_t chart = 0;
    glm::ivec2 place{0};
};

TexelPlace place_of(const PreparedLightmaps& prepared, uint32_t texel) {
    const auto& first = prepared.texels.first_texel;
    const auto next = std::ranges::upper_bound(first, texel);
    const auto instance = static_cast<uint32_t>(next - first.begin() - 1);
    const TexelMap& map = prepared.maps[prepared.layout.places[instance].packing];
    const uint32_t index = map.texels[texel - first[instance]].index;
    return {instance, map.charts[index], glm::ivec2(index % map.width, index / map.width)};
}

/// The light of texels by a cache, green.
double mean_light(const RadianceCache& cache, std::span<const uint32_t> texels) {
    double sum = 0.0;
    for (const uint32_t texel : texels) {
        const RadianceCache::Irradiance& light = cache.irradiance[texel];
        sum += double{light.direct().y + light.reflected.y};
    }
    return sum / static_cast<double>(texels.size());
}

/// Squares of 16 x 16 texels of a bake that have light, and what the filter reads around them.
struct Windows {
    PreparedLightmaps prepared;   ///< only their texels are baked
    std::vector<uint32_t> inner;  ///< of `prepared.baked`

    Windows(const PreparedLightmaps& whole, const RadianceCache& cache, size_t count)
        : prepared(whole) {
        constexpr int kHalf = 8, kMargin = 12;
        const double least_light = kLeastLight * mean_light(cache, whole.baked);
        std::mt19937 engine(5);
        std::vector<int> distance(whole.baked.size(), kHalf + kMargin);
        for (size_t tries = 0; count > 0 && tries < 10'000; ++tries) {
            const size_t middle = engine() % whole.baked.size();
            const TexelPlace center = place_of(whole, whole.baked[middle]);
            std::vector<std::pair<size_t, int>> around;
            std::vector<uint32_t> inside;
            for_each_of(whole, center.instance, [&](size_t i, const TexelPlace& texel) {
                if (texel.chart != center.chart) return;
                const glm::ivec2 offset = glm::abs(2 * (texel.place - center.place) + 1);
                const int far = std::max(offset.x, offset.y) / 2;
                if (far < kHalf + kMargin) around.emplace_back(i, far);
                if (far < kHalf) inside.push_back(whole.baked[i]);
            });
            if (inside.size() < 3 * kHalf * kHalf || mean_light(cache, inside) < least_light)
                continue;
            for (const auto& [i, far] : around) distance[i] = std::min(distance[i], far);
            --count;
        }
        prepared.baked.clear();
        prepared.positions.clear();
        prepared.surfaces.clear();
        for (size_t i = 0; i < distance.size(); ++i) {
            if (distance[i] == kHalf + kMargin) continue;
            if (distance[i] < kHalf) inner.push_back(static_cast<uint32_t>(prepared.baked.size()));
            prepared.baked.push_back(whole.baked[i]);
            prepared.positions.push_back(whole.positions[i]);
            prepared.surfaces.push_back(whole.surfaces[i]);
        }
    }

  private:
    template <class Visit>
    static void for_each_of(const PreparedLightmaps& whole, uint32_t instance, const Visit& visit) {
        const auto& first = whole.texels.first_texel;
        const auto begin = std::ranges::lower_bound(whole.baked, first[instance]);
        const auto end = std::ranges::lower_bound(whole.baked, first[instance + 1]);
        for (auto it = begin; it != end; ++it)
            visit(static_cast<size_t>(it - whole.baked.begin()), place_of(whole, *it));
    }
};

/// The light of baked texels.
struct Sampled {
    TexelBake bake;
    double seconds = 0.0;
};

Sampled sample(const Scene& scene, const PreparedLightmaps& prepared, uint32_t sample_count,
               const RadianceCache* cache, uint64_t seed) {
    BakeSettings settings = prepared.settings.bake;
    settings.sample_count = sample_count;
    settings.seed = seed;
    Sampled sampled;
    sampled.bake.accumulators.resize(prepared.baked.size());
    for (const auto& surface : prepared.surfaces) sampled.bake.normals.push_back(surface.normal);
    BakePlaces places = prepared.places();
    places.surfaces.cache = cache;
    sampled.seconds = seconds([&] {
        require(bool(bake_accumulators(scene, places, settings, sampled.bake.accumulators)),
                "bake");
    });
    return sampled;
}

TexelLights lights_of(PreparedLightmaps& prepared, const TexelBake& bake, bool is_filtered) {
    prepared.settings.is_unfiltered = !is_filtered;
    return {prepared, bake};
}

/// The light of the inner texels, with its error.
std::vector<GreenLight> inner_lights(Windows& windows, const TexelBake& bake, bool is_filtered) {
    const TexelLights lights = lights_of(windows.prepared, bake, is_filtered);
    std::vector<GreenLight> inner;
    for (const uint32_t i : windows.inner) {
        const auto light = double{lights.total(i).irradiance.y};
        inner.push_back({light, light * double{lights.error(i)}});
    }
    return inner;
}

/// Root mean square of errors in relation to the light, over lit texels. `square`: of the error of
/// a texel.
template <class Square>
double relative_root(const std::vector<GreenLight>& truth, const Square& square) {
    double mean = 0.0;
    for (const GreenLight& light : truth) mean += light.value / static_cast<double>(truth.size());
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
        if (truth[i].value < kLeastLight * mean) continue;
        sum += square(i) / (truth[i].value * truth[i].value);
        ++count;
    }
    return std::sqrt(std::max(0.0, sum) / static_cast<double>(count));
}

/// Without the noise of the truth.
double relative_error(const std::vector<GreenLight>& lights, const std::vector<GreenLight>& truth) {
    return relative_root(truth, [&](size_t i) {
        const double difference = lights[i].value - truth[i].value;
        return difference * difference - truth[i].error * truth[i].error;
    });
}

/// What error bars say of it.
double told_error(const std::vector<GreenLight>& lights, const std::vector<GreenLight>& truth) {
    return relative_root(truth, [&](size_t i) { return lights[i].error * lights[i].error; });
}

double mean_of(const std::vector<GreenLight>& lights) {
    double sum = 0.0;
    for (const GreenLight& light : lights) sum += light.value;
    return sum / static_cast<double>(lights.size());
}

/// A box of 1 m on a floor under a white sky, 10 texels a metre.
Scene box_on_floor() {
    Scene scene;
    Material grey;
    grey.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    Mesh floor;
    append_quad(floor, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    add_mesh(scene, std::move(floor), grey);
    add_mesh(scene, box_mesh(WorldBox{{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}}), grey);
    scene.environment.radiance = glm::vec3(1.0f);
    return scene;
}

/// The row of texels beside the box that a place on the floor is in.
std::optional<size_t> row_beside_box(glm::dvec3 position) {
    const glm::dvec2 side = glm::abs(glm::dvec2(position.x, position.z));
    const double distance = std::max(side.x, side.y) - 0.5;
    if (position.y > 1e-3 || std::min(side.x, side.y) > 0.4 || distance < 0.0) return std::nullopt;
    return static_cast<size_t>(distance / 0.1);
}

}  // namespace

void bench_contact_shadow() {
    const Scene scene = box_on_floor();
    BakeLightmapsSettings settings;
    settings.layout.page_size = 128;
    auto prepared = prepare_lightmaps(scene, settings);
    require(bool(prepared), "the box has texels");
    constexpr uint32_t kSamples = 128, kManySamples = 1u << 15;
    const TexelBake noisy = sample(scene, *prepared, kSamples, nullptr, 2).bake;
    const TexelBake exact = sample(scene, *prepared, kManySamples, nullptr, 1).bake;
    const TexelLights filtered = lights_of(*prepared, noisy, true);
    const TexelLights truth = lights_of(*prepared, exact, false);
    std::array<glm::dvec2, 3> rows{};
    for (uint32_t i = 0; i < prepared->baked.size(); ++i) {
        const auto row = row_beside_box(prepared->positions[i]);
        if (!row || *row >= rows.size()) continue;
        rows[*row] += glm::dvec2(filtered.total(i).irradiance.y, truth.total(i).irradiance.y);
    }
    double worst = 0.0;
    for (const glm::dvec2& row : rows) worst = std::max(worst, std::abs(row.x / row.y - 1.0));
    report("lightmap.filter_edge", worst,
           "largest relative change of the mean of the first three rows of texels beside a box");
}

void bench_lightmap_filter(const Scene& scene, const std::string& name) {
    BakeLightmapsSettings settings;
    settings.layout.page_size = 4096;
    const auto prepared = prepare_lightmaps(scene, settings);
    require(bool(prepared), "the scene has texels");
    const auto [cache, cache_each] = make_timed_cache(scene, *prepared);
    Windows windows(*prepared, cache, 12);
    const auto all = static_cast<double>(windows.prepared.baked.size());

    // The truth, of the inner texels alone.
    Windows inner = windows;
    PreparedLightmaps& alone = inner.prepared;
    alone.baked.clear();
    alone.positions.clear();
    alone.surfaces.clear();
    for (const uint32_t i : windows.inner) {
        alone.baked.push_back(windows.prepared.baked[i]);
        alone.positions.push_back(windows.prepared.positions[i]);
        alone.surfaces.push_back(windows.prepared.surfaces[i]);
    }
    for (uint32_t i = 0; i < inner.inner.size(); ++i) inner.inner[i] = i;
    const std::vector<GreenLight> truth =
        inner_lights(inner, sample(scene, alone, 1u << 15, nullptr, 1).bake, false);

    constexpr uint32_t kPlain = 512;
    constexpr double kTarget = 0.05;
    const Sampled plain = sample(scene, alone, kPlain, nullptr, 2);
    const double plain_error = relative_error(inner_lights(inner, plain.bake, false), truth);
    const double plain_time = plain.seconds / static_cast<double>(alone.baked.size()) *
                              std::pow(plain_error / kTarget, 2);
    report("lightmap.plain_paths." + name, kPlain * std::pow(plain_error / kTarget, 2),
           "paths a texel to 5 % without cache and filter");

    double last_error = 0.0, last_time = 0.0, time = 0.0;
    for (uint32_t count = 16; count <= 8192 && time == 0.0; count *= 2) {
        const Sampled sampled = sample(scene, windows.prepared, count, &cache, 2);
        std::vector<GreenLight> filtered;
        const double filter_seconds =
            seconds([&] { filtered = inner_lights(windows, sampled.bake, true); });
        const std::vector<GreenLight> raw = inner_lights(windows, sampled.bake, false);
        const double error = relative_error(filtered, truth);
        const double raw_error = relative_error(raw, truth);
        report("lightmap.filtered_error." + name + "." + std::to_string(count), error,
               "relative, RMS");
        report("lightmap.raw_error." + name + "." + std::to_string(count), raw_error,
               "relative, RMS");
        report("lightmap.filter." + name + "." + std::to_string(count),
               std::pow(raw_error / error, 2), "equivalent samples");
        report("lightmap.filter_error_bar." + name + "." + std::to_string(count),
               told_error(filtered, truth) / error, "told / true error, RMS");
        report("lightmap.filter_bias." + name + "." + std::to_string(count),
               mean_of(filtered) / mean_of(raw) - 1.0, "filtered / raw - 1");
        const double now = (sampled.seconds + filter_seconds) / all + cache_each;
        if (error <= kTarget) {
            const double t = last_error > 0.0
                                 ? std::log(last_error / kTarget) / std::log(last_error / error)
                                 : 1.0;
            time = last_error > 0.0 ? last_time * std::pow(now / last_time, t) : now;
        }
        last_error = error;
        last_time = now;
    }
    report("lightmap.texel_time." + name, 1e6 * time, "us to 5 %");
    report("lightmap.cache_share." + name, cache_each / time, "of this time");
    report("lightmap.time_to_5_percent." + name, plain_time / time, "plain / ours");
}

}  // namespace tetralight::bench
