// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/texel_lights.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include <tetralight/bake/lightmap/chart_means.h>
#include <tetralight/bake/lightmap/filter_texels.h>
#include <tetralight/bake/lightmap/pooled_variance.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/lightmap/directional_light.h>

namespace tetralight {
namespace {

/// Texels that a thread takes at once.
constexpr size_t kChunk = 1024;

/// Of the squares over which the differences of halves are averaged, in texels.
constexpr int kErrorRadius = 2;

constexpr size_t kCoefficients = LightGroupLayout::kLayerSize;

using Coefficients = std::array<double, kCoefficients>;

Coefficients flat(const RadianceSums& sums) {
    Coefficients values{};
    for (size_t i = 0; i < sums.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel)
            values[3 * i + static_cast<size_t>(channel)] = sums[i][channel];
    }
    return values;
}

/// The sums of one texel: the total, the layers of the plan, and the rest if there is one.
std::vector<Coefficients> sums_of(const TexelBake& bake, const LightGroupLayout& layout,
                                  size_t texel, size_t value_count) {
    std::vector<Coefficients> sums{flat(bake.accumulators[texel].radiance_sum)};
    const auto row = std::span(bake.rows).subspan(texel * layout.size(), layout.size());
    for (size_t layer = 0; layer < layout.layer_count; ++layer) {
        const auto values = row.subspan(layer * kCoefficients, kCoefficients);
        std::ranges::copy(values, sums.emplace_back().begin());
    }
    if (sums.size() == value_count) return sums;
    Coefficients rest = sums[0];
    for (size_t layer = 1; layer < sums.size(); ++layer) {
        for (size_t i = 0; i < kCoefficients; ++i) rest[i] -= sums[layer][i];
    }
    sums.push_back(rest);
    return sums;
}

double sample_count(const ProbeAccumulator& sums) {
    return static_cast<double>(std::max<uint64_t>(1, sums.sample_count));
}

template <class Work>
void for_each_texel(const TexelBake& bake, uint32_t thread_count, const Work& work) {
    const size_t count = bake.accumulators.size();
    parallel_for((count + kChunk - 1) / kChunk, thread_count, [&](size_t chunk) {
        const size_t end = std::min(count, (chunk + 1) * kChunk);
        for (size_t i = chunk * kChunk; i < end; ++i) work(i);
    });
}

/// Variance of the mean of both halves of a filtered texel, by the noise of the texels it takes.
double variance_left(std::span<const NoisyTexel> texels, std::span<const TexelShare> shares) {
    double variance = 0.0;
    for (const TexelShare& share : shares) {
        for (const float weight : share.halves) {
            const auto half = 0.5 * double{weight};
            variance += half * half * double{texels[share.texel].variance};
        }
    }
    return variance;
}

/// Square of the relative error by the limit of bounces.
double cut_square(const ProbeAccumulator& sums) {
    const auto all = double{sums.standard_error(ErrorMeasure::OwnNormal)};
    const auto sampling = double{sums.sampling_error(ErrorMeasure::OwnNormal)};
    return all > 0.0 ? all * all - sampling * sampling : 0.0;
}

/// The mean irradiance on normals near that of the texel.
void set_mapped_irradiance(TexelLight& light, const glm::vec3& base,
                           std::span<const glm::vec3> normals) {
    light.irradiance = glm::vec3(0.0f);
    for (const glm::vec3& normal : normals) {
        for (int c = 0; c < 3; ++c) {
            light.irradiance[c] +=
                directional_irradiance(light.flux[c], light.vector[c], base, normal) /
                static_cast<float>(normals.size());
        }
    }
}

/// The charts in the pages, with the baked texels.
PageCharts page_charts(const PreparedLightmaps& prepared) {
    const Lightmaps& maps = prepared.lightmaps;
    PageCharts pages(maps.info.page_size, maps.info.page_count);
    auto baked = prepared.baked.begin();
    for (size_t instance = 0; instance < maps.rectangles.size(); ++instance) {
        const LightmapRectangle& place = maps.rectangles[instance];
        if (place.page == kNoIndex) continue;
        const TexelMap& map = prepared.maps[place.mesh];
        const glm::ivec2 corner(place.x, place.y);
        pages.add(place.page, corner, map.width, map.charts);
        const uint32_t first = prepared.texels.first_texel[instance];
        const uint32_t last = prepared.texels.first_texel[instance + 1];
        for (; baked != prepared.baked.end() && *baked < last; ++baked) {
            const uint32_t index = map.texels[*baked - first].index;
            pages.set_texel(place.page, corner + glm::ivec2(index % map.width, index / map.width),
                            static_cast<uint32_t>(baked - prepared.baked.begin()));
        }
    }
    pages.add_seams(prepared.seams);
    return pages;
}

}  // namespace

TexelLights::TexelLights(const PreparedLightmaps& prepared, const TexelBake& bake)
    : value_count_(1 + prepared.lightmaps.layers.size()),
      lights_(value_count_ * bake.accumulators.size()),
      errors_(bake.accumulators.size()) {
    const bool is_filtered = !prepared.settings.is_unfiltered;
    std::vector<TexelHalves> halves(is_filtered ? lights_.size() : 0);
    const LightGroupLayout layout(prepared.settings.bake.plan);
    for_each_texel(bake, prepared.settings.bake.thread_count, [&](size_t texel) {
        const double count = sample_count(bake.accumulators[texel]);
        const glm::vec3 normal = bake.normals[texel];
        const auto sums = sums_of(bake, layout, texel, value_count_);
        const double first_half_count = sums[0].back();
        errors_[texel] = bake.accumulators[texel].standard_error(ErrorMeasure::OwnNormal);
        for (size_t i = 0; i < value_count_; ++i) {
            const size_t value = index(texel) + i;
            lights_[value] = texel_light(sums[i], count, normal);
            if (is_filtered) halves[value] = texel_halves(sums[i], count, first_half_count, normal);
        }
    });
    if (is_filtered) filter(prepared, bake, halves);
    if (!bake.mapped_normals.empty()) map_normals(bake, prepared.settings.bake.thread_count);
}

void TexelLights::map_normals(const TexelBake& bake, uint32_t thread_count) {
    for_each_texel(bake, thread_count, [&](size_t texel) {
        const std::span<const glm::vec3> normals = bake.mapped_normals_of(texel);
        if (normals.empty()) return;
        const auto values = std::span(lights_).subspan(index(texel), value_count_);
        for (TexelLight& light : values) set_mapped_irradiance(light, bake.normals[texel], normals);
        if (value_count_ == 1) return;
        values[0].irradiance = glm::vec3(0.0f);
        for (const TexelLight& layer : values.subspan(1)) values[0].irradiance += layer.irradiance;
    });
}

std::vector<NoisyTexel> TexelLights::noisy_texels(const TexelBake& bake,
                                                  std::span<const TexelHalves> halves) const {
    std::vector<NoisyTexel> noisy;
    for (size_t texel = 0; texel < bake.accumulators.size(); ++texel) {
        const ProbeAccumulator& accumulator = bake.accumulators[texel];
        const double count = sample_count(accumulator);
        const TexelHalves& total = halves[index(texel)];
        // A half has half of the samples.
        noisy.push_back({{total[0].irradiance, total[1].irradiance},
                         static_cast<float>(2.0 * accumulator.variance_sum / (count * count)),
                         static_cast<float>(count),
                         bake.normals[texel]});
    }
    return noisy;
}

TexelHalves TexelLights::filtered_halves(std::span<const TexelHalves> halves,
                                         std::span<const TexelShare> shares, size_t value) const {
    TexelHalves filtered;
    for (const TexelShare& share : shares) {
        const TexelHalves& other = halves[index(share.texel) + value];
        for (size_t half = 0; half < 2; ++half)
            filtered[half] += other[half] * (0.5f * share.halves[half]);
    }
    return filtered;
}

void TexelLights::filter(const PreparedLightmaps& prepared, const TexelBake& bake,
                         std::span<const TexelHalves> halves) {
    const std::vector<NoisyTexel> noisy = noisy_texels(bake, halves);
    const PageCharts pages = page_charts(prepared);
    const uint32_t threads = prepared.settings.bake.thread_count;
    // Of the total: squares of half the difference of the filtered halves, the variance that the
    // weights leave, and the square of the light.
    std::vector<double> differences(noisy.size()), variances(noisy.size()), squares(noisy.size());
    filter_texels(
        pages, noisy, {}, threads, [&](uint32_t texel, std::span<const TexelShare> shares) {
            const glm::vec3 normal = bake.normals[texel];
            for (size_t i = 0; i < value_count_; ++i) {
                const TexelHalves filtered = filtered_halves(halves, shares, i);
                TexelLight light = filtered[0];
                light += filtered[1];
                light.irradiance = glm::max(normal * light.vector, 0.0f);
                lights_[index(texel) + i] = light;
                if (i > 0) continue;
                const glm::dvec3 difference(normal * (filtered[0].vector - filtered[1].vector));
                differences[texel] = glm::dot(difference, difference);
                const glm::dvec3 own(light.irradiance);
                squares[texel] = glm::dot(own, own);
            }
            variances[texel] = variance_left(noisy, shares);
        });
    const auto around = chart_means(pages, differences, kErrorRadius, threads);
    const auto squares_around = chart_means(pages, squares, kErrorRadius, threads);
    for (size_t texel = 0; texel < noisy.size(); ++texel) {
        const double square = squares[texel];
        const double sampled =
            pooled_variance(differences[texel], around[texel], square, squares_around[texel]);
        const double variance = std::max(sampled, variances[texel]);
        errors_[texel] = 0.0f;
        if (!(square > 0.0 && variance > 0.0)) continue;
        const double relative = std::min(1.0, variance / square);
        errors_[texel] =
            static_cast<float>(std::sqrt(relative + cut_square(bake.accumulators[texel])));
    }
}

}  // namespace tetralight
