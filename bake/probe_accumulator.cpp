// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_accumulator.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <tetralight/bake/round_variance.h>

namespace tetralight {
namespace {

/// `irradiance_square` of light that arrives evenly from all directions, or above the surface.
double lost_square(const CutLight& cut, ErrorMeasure measure) {
    constexpr double kY0 = 0.28209479177387814;
    const glm::dvec3 lost = cut.lost_radiance();
    const double factor =
        measure == ErrorMeasure::OwnNormal ? std::numbers::pi * kY0 : std::numbers::pi;
    return factor * factor * glm::dot(lost, lost);
}

}  // namespace

void ProbeAccumulator::add_round(std::span<const ProbeEstimate> estimates, ErrorMeasure measure) {
    std::vector<WeightedLight> lights;
    lights.reserve(estimates.size());
    for (const ProbeEstimate& estimate : estimates) {
        WeightedLight& light = lights.emplace_back();
        light.sample_count = estimate.sample_count;
        for (int i = 0; i < kShCoefficientCount; ++i) {
            light.radiance[i] = glm::dvec3(estimate.radiance.coefficients[i]);
        }
        sample_count += estimate.sample_count;
        back_face_count += estimate.back_face_count;
        ray_count += estimate.ray_count;
        cut.add(estimate.cut);
    }
    const RadianceSums sum = weighted_sum(lights);
    for (int i = 0; i < kShCoefficientCount; ++i) radiance_sum[i] += sum[i];
    variance_sum += round_variance(lights, sum, measure);
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

float ProbeAccumulator::sampling_error(ErrorMeasure measure) const noexcept {
    const double square = irradiance_square(radiance_sum, measure);  // both sums have a factor N²
    return square > 0.0 ? static_cast<float>(std::sqrt(variance_sum / square)) : 0.0f;
}

float ProbeAccumulator::standard_error(ErrorMeasure measure) const noexcept {
    const double square = irradiance_square(radiance_sum, measure);
    if (square <= 0.0 || variance_sum <= 0.0) return 0.0f;
    const double lost = lost_square(cut, measure);
    return static_cast<float>(std::sqrt((variance_sum + lost) / square));
}

}  // namespace tetralight
