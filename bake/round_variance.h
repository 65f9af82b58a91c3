// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>

#include <tetralight/probes/sh.h>

namespace tetralight {

/// Radiance coefficients, or sums of them.
using RadianceSums = std::array<glm::dvec3, kShCoefficientCount>;

/// The irradiance whose error a bake measures.
enum class ErrorMeasure : uint8_t {
    AllNormals,  ///< of probes: the root mean square over all normals
    OwnNormal,   ///< of texels: that of the surface, whose normal is +Z of the coefficients
};

/// `AllNormals`: Σ A_l² c_i² over nine RGB coefficients of radiance, 4π times the mean square of
/// the irradiance over all normals; A = π, 2π/3, π/4. `OwnNormal`: the square of ∫ L(ω) ω_z dω,
/// which is the irradiance if light arrives above the surface only.
[[nodiscard]] inline double irradiance_square(
    const RadianceSums& radiance, ErrorMeasure measure = ErrorMeasure::AllNormals) noexcept {
    if (measure == ErrorMeasure::OwnNormal) {
        constexpr double kY1 = 0.4886025119029199;  // Y_2 = kY1 z
        return glm::dot(radiance[2], radiance[2]) / (kY1 * kY1);
    }
    constexpr double kPi = std::numbers::pi;
    constexpr double kBandFactors[] = {kPi, 2.0 * kPi / 3.0, kPi / 4.0};
    double sum = 0.0;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const double factor = kBandFactors[i == 0 ? 0 : i < 4 ? 1 : 2];
        sum += factor * factor * glm::dot(radiance[i], radiance[i]);
    }
    return sum;
}

/// Light of one of the estimates of a round.
struct WeightedLight {
    RadianceSums radiance{};
    double sample_count = 0.0;
};

/// Σ samples · radiance.
[[nodiscard]] inline RadianceSums weighted_sum(std::span<const WeightedLight> estimates) noexcept {
    RadianceSums sum{};
    for (const WeightedLight& estimate : estimates) {
        for (int i = 0; i < kShCoefficientCount; ++i) {
            sum[i] += estimate.sample_count * estimate.radiance[i];
        }
    }
    return sum;
}

/// Samples² · variance of the mean irradiance of K estimates x_k with n_k of N samples, whose
/// `weighted_sum` is `sum`: N² Σ n_k/N |x_k − mean|² / (K − 1). Unbiased if the variance of an
/// estimate is proportional to 1/n_k. 0 for fewer than two estimates, whose variance is unknown.
[[nodiscard]] inline double round_variance(std::span<const WeightedLight> estimates,
                                           const RadianceSums& sum, ErrorMeasure measure) noexcept {
    if (estimates.size() < 2) return 0.0;
    double sample_count = 0.0;
    for (const WeightedLight& estimate : estimates) sample_count += estimate.sample_count;
    double variance = 0.0;
    for (const WeightedLight& estimate : estimates) {
        RadianceSums difference;
        for (int i = 0; i < kShCoefficientCount; ++i) {
            difference[i] = estimate.radiance[i] - sum[i] / sample_count;
        }
        variance += estimate.sample_count / sample_count * irradiance_square(difference, measure);
    }
    return sample_count * sample_count * variance / static_cast<double>(estimates.size() - 1);
}

}  // namespace tetralight
