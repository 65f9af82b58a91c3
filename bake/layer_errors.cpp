// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/layer_errors.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/round_variance.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {
namespace {

/// Where a layer counts: at places with at least this fraction of its mean light.
constexpr double kCountedFraction = 0.01;

constexpr uint32_t kPlaceCount = 64;
constexpr uint32_t kSamplesPerPlace = 128;
/// Places where more samples hit a back face first are inside geometry.
constexpr double kMaxBackFaceFraction = 0.25;

template <class Number>
RadianceSums layer_light(std::span<const Number> row, uint32_t layer) {
    RadianceSums light{};
    const auto values = row.subspan(layer * LightGroupLayout::kLayerSize);
    for (size_t i = 0; i < LightGroupLayout::kLayerSize; ++i) {
        light[i / 3][static_cast<int>(i % 3)] = static_cast<double>(values[i]);
    }
    return light;
}

/// The light of one layer, or of the rest.
template <class Number>
RadianceSums layer_or_rest(const LightGroupLayout& layout, std::span<const Number> row,
                           uint32_t layer, RadianceSums total) {
    if (layer < layout.layer_count) return layer_light(row, layer);
    for (uint32_t other = 0; other < layout.layer_count; ++other) {
        const RadianceSums light = layer_light(row, other);
        for (size_t i = 0; i < light.size(); ++i) total[i] -= light[i];
    }
    return total;
}

RadianceSums light_of(const ProbeEstimate& estimate, const LightGroupLayout& layout,
                      uint32_t layer) {
    RadianceSums total{};
    for (size_t i = 0; i < total.size(); ++i) {
        total[i] = glm::dvec3(estimate.radiance.coefficients[i]);
    }
    return layer_or_rest(layout, std::span(estimate.light_groups), layer, total);
}

/// Squares of the light of all layers at one place; empty if it is inside geometry.
std::vector<double> squares_at(const PathTracer& tracer, const glm::dvec3& place, uint64_t seed,
                               const DirectionSet& directions) {
    const LightGroupLayout layout(tracer.plan());
    const ProbeEstimate estimate = estimate_probe(
        tracer, tracer.trace_scene().render_from_world(place), probe_key(seed, place), directions);
    if (estimate.back_face_count > kMaxBackFaceFraction * estimate.sample_count) return {};
    std::vector<double> squares;
    for (uint32_t layer = 0; layer < layout.variance_count(); ++layer) {
        squares.push_back(
            irradiance_square(light_of(estimate, layout, layer), ErrorMeasure::AllNormals));
    }
    return squares;
}

std::vector<glm::dvec3> random_places(const WorldBox& bounds, uint64_t seed) {
    std::vector<glm::dvec3> places;
    for (uint32_t i = 0; i < kPlaceCount; ++i) {
        RandomStream random(seed, i);
        glm::dvec3 place;
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] = bounds.min[axis] + bounds.size()[axis] * double{random.next()};
        }
        places.push_back(place);
    }
    return places;
}

}  // namespace

void add_layer_variances(const LightGroupLayout& layout, std::span<const ProbeEstimate> estimates,
                         std::span<double> row, ErrorMeasure measure) {
    std::vector<WeightedLight> lights(estimates.size());
    for (uint32_t layer = 0; layer < layout.variance_count(); ++layer) {
        for (size_t i = 0; i < estimates.size(); ++i) {
            lights[i] = {light_of(estimates[i], layout, layer),
                         static_cast<double>(estimates[i].sample_count)};
        }
        row[layout.variance_begin() + layer] +=
            round_variance(lights, weighted_sum(lights), measure);
    }
}

std::vector<float> layer_errors(const LightGroupLayout& layout, const ProbeAccumulator& accumulator,
                                std::span<const double> row, ErrorMeasure measure) {
    std::vector<float> errors;
    for (uint32_t layer = 0; layer < layout.variance_count(); ++layer) {
        const double square =
            irradiance_square(layer_or_rest(layout, row, layer, accumulator.radiance_sum), measure);
        const double variance = row[layout.variance_begin() + layer];
        const auto error = static_cast<float>(std::sqrt(variance / square));
        errors.push_back(square > 0.0 && std::isfinite(error) ? error : 0.0f);
    }
    return errors;
}

float worst_layer_error(const LightGroupLayout& layout, const ProbeAccumulator& accumulator,
                        std::span<const double> row, std::span<const double> mean_light,
                        ErrorMeasure measure) {
    const auto sample_count = static_cast<double>(accumulator.sample_count);
    double worst = 0.0;
    for (uint32_t layer = 0; layer < layout.variance_count(); ++layer) {
        const double least = kCountedFraction * mean_light[layer] * sample_count;
        const double square =
            irradiance_square(layer_or_rest(layout, row, layer, accumulator.radiance_sum), measure);
        const double scale = std::max(square, least * least);
        if (scale > 0.0)
            worst = std::max(worst, std::sqrt(row[layout.variance_begin() + layer] / scale));
    }
    return static_cast<float>(worst);
}

std::vector<double> mean_layer_light(const Scene& scene, const PathTracer& tracer, uint64_t seed,
                                     uint32_t thread_count) {
    const LightGroupLayout layout(tracer.plan());
    std::vector<double> mean(layout.variance_count(), 0.0);
    const auto bounds =
        scene_bounds(scene, [](const MeshInstance& instance) { return instance.contributes_gi; });
    if (!bounds) return mean;
    const std::vector<glm::dvec3> places = random_places(*bounds, seed);
    const DirectionSet directions(kSamplesPerPlace);
    std::vector<std::vector<double>> squares(places.size());
    parallel_for(places.size(), thread_count,
                 [&](size_t i) { squares[i] = squares_at(tracer, places[i], seed, directions); });
    size_t count = 0;
    for (const std::vector<double>& place : squares) {
        count += !place.empty();
        for (size_t layer = 0; layer < place.size(); ++layer)
            mean[layer] += std::sqrt(place[layer]);
    }
    for (double& light : mean) light /= static_cast<double>(std::max<size_t>(count, 1));
    return mean;
}

}  // namespace tetralight
