// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/layer_noise.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace tetralight {
namespace {

/// Where a layer counts: at probes with at least this fraction of its mean light.
constexpr double kCountedFraction = 0.01;

/// |E|²: 4π times the mean square over all normals.
double square_of(const IrradianceSh& light) noexcept {
    double sum = 0.0;
    for (const glm::vec3& c : light.coefficients) {
        for (int channel = 0; channel < 3; ++channel) {
            sum += static_cast<double>(c[channel]) * static_cast<double>(c[channel]);
        }
    }
    return sum;
}

NoiseStatistics statistics_of(std::vector<float> errors) {
    std::erase(errors, 0.0f);
    std::ranges::sort(errors);
    if (errors.empty()) return {};
    const auto quantile = [&](double fraction) {
        const double rank = std::ceil(fraction * static_cast<double>(errors.size()));
        return errors[static_cast<size_t>(rank) - 1];
    };
    return {static_cast<uint32_t>(errors.size()), quantile(0.5), quantile(0.99), errors.back()};
}

bool knows_layer_errors(const ProbeVolumeView& volume) noexcept {
    return !volume.layer_errors.empty() &&
           volume.layer_errors.size() == volume.layer_irradiance.size() &&
           volume.layer_errors.size() ==
               layer_element_count(volume.layers.size(), volume.positions.size());
}

NoiseStatistics noise_of_layer(std::span<const IrradianceSh> light, std::span<const float> errors) {
    double mean = 0.0;
    for (const IrradianceSh& one : light) mean += std::sqrt(square_of(one));
    mean /= static_cast<double>(std::max<size_t>(light.size(), 1));
    std::vector<float> counted;
    for (size_t i = 0; i < light.size(); ++i) {
        if (std::sqrt(square_of(light[i])) >= kCountedFraction * mean) counted.push_back(errors[i]);
    }
    return statistics_of(std::move(counted));
}

}  // namespace

std::vector<NoiseStatistics> layer_noise(const ProbeVolumeView& volume) {
    std::vector<NoiseStatistics> noise;
    if (!knows_layer_errors(volume)) return noise;
    const size_t count = volume.positions.size();
    for (size_t layer = 0; layer < volume.layers.size(); ++layer) {
        noise.push_back(noise_of_layer(volume.layer_irradiance.subspan(layer * count, count),
                                       volume.layer_errors.subspan(layer * count, count)));
    }
    return noise;
}

float relit_error(const ProbeVolumeView& volume, uint32_t probe) noexcept {
    const auto is_one = [](const Layer& layer) { return layer.weight == 1.0f; };
    if (!knows_layer_errors(volume) || std::ranges::all_of(volume.layers, is_one)) {
        return volume.health.empty() ? 0.0f : volume.health[probe].standard_error;
    }
    double variance = 0.0;
    IrradianceSh sum;
    for (size_t layer = 0; layer < volume.layers.size(); ++layer) {
        const size_t element = layer * volume.positions.size() + probe;
        const float weight = volume.layers[layer].weight;
        const double error = static_cast<double>(weight * volume.layer_errors[element]);
        variance += error * error * square_of(volume.layer_irradiance[element]);
        sum += weight * volume.layer_irradiance[element];
    }
    const auto error = static_cast<float>(std::sqrt(variance / square_of(sum)));
    return std::isfinite(error) ? error : 0.0f;
}

NoiseStatistics relit_noise(const ProbeVolumeView& volume) {
    std::vector<float> errors;
    for (uint32_t i = 0; i < volume.probe_count(); ++i) errors.push_back(relit_error(volume, i));
    return statistics_of(std::move(errors));
}

}  // namespace tetralight
