// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_accumulator.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

using Coefficients = std::array<glm::dvec3, kShCoefficientCount>;

/// Σ A_l² c_i² over nine RGB coefficients: 4π times the mean square over all normals.
double irradiance_square(const Coefficients& radiance) {
    constexpr double kPi = std::numbers::pi;
    constexpr double kBandFactors[] = {kPi, 2.0 * kPi / 3.0, kPi / 4.0};
    double sum = 0.0;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const double factor = kBandFactors[i == 0 ? 0 : i < 4 ? 1 : 2];
        sum += factor * factor * glm::dot(radiance[i], radiance[i]);
    }
    return sum;
}

Coefficients weighted_sum(std::span<const ProbeEstimate> estimates) {
    Coefficients sum{};
    for (const ProbeEstimate& estimate : estimates) {
        for (int i = 0; i < kShCoefficientCount; ++i) {
            sum[i] += static_cast<double>(estimate.sample_count) *
                      glm::dvec3(estimate.radiance.coefficients[i]);
        }
    }
    return sum;
}

/// Variance of the mean of K estimates x_k with n_k of N samples: Σ n_k/N |x_k − mean|² / (K − 1).
/// Unbiased if the variance of an estimate is proportional to 1/n_k.
double variance_of_mean(std::span<const ProbeEstimate> estimates, const Coefficients& sum,
                        double sample_count) {
    double variance = 0.0;
    for (const ProbeEstimate& estimate : estimates) {
        Coefficients difference;
        for (int i = 0; i < kShCoefficientCount; ++i) {
            difference[i] = glm::dvec3(estimate.radiance.coefficients[i]) - sum[i] / sample_count;
        }
        variance += estimate.sample_count / sample_count * irradiance_square(difference);
    }
    return variance / static_cast<double>(estimates.size() - 1);
}

}  // namespace

void ProbeAccumulator::add_round(std::span<const ProbeEstimate> estimates) noexcept {
    const Coefficients sum = weighted_sum(estimates);
    uint64_t samples = 0;
    for (const ProbeEstimate& estimate : estimates) {
        samples += estimate.sample_count;
        back_face_count += estimate.back_face_count;
        ray_count += estimate.ray_count;
        cut.add(estimate.cut);
    }
    for (int i = 0; i < kShCoefficientCount; ++i) radiance_sum[i] += sum[i];
    if (estimates.size() > 1) {
        const auto count = static_cast<double>(samples);
        variance_sum += count * count * variance_of_mean(estimates, sum, count);
    }
    sample_count += samples;
    ++round_count;
}

RadianceSh ProbeAccumulator::radiance() const noexcept {
    RadianceSh mean;
    if (sample_count == 0) return mean;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        mean.coefficients[i] = glm::vec3(radiance_sum[i] / static_cast<double>(sample_count));
    }
    return mean;
}

float ProbeAccumulator::validity() const noexcept {
    if (sample_count == 0) return 1.0f;
    return static_cast<float>(1.0 - static_cast<double>(back_face_count) /
                                        static_cast<double>(sample_count));
}

float ProbeAccumulator::sampling_error() const noexcept {
    const double square = irradiance_square(radiance_sum);  // both sums have a factor N²
    return square > 0.0 ? static_cast<float>(std::sqrt(variance_sum / square)) : 0.0f;
}

float ProbeAccumulator::standard_error() const noexcept {
    const double square = irradiance_square(radiance_sum);
    if (square <= 0.0 || variance_sum <= 0.0) return 0.0f;
    Coefficients lost{};
    lost[0] = cut.lost_radiance();
    return static_cast<float>(std::sqrt((variance_sum + irradiance_square(lost)) / square));
}

}  // namespace tetralight
