// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/texel_light.h>

#include <array>
#include <cstddef>
#include <glm/common.hpp>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

constexpr double kY0 = 0.28209479177387814, kY1 = 0.4886025119029199;

/// Coefficients that lightmaps need.
constexpr size_t kUsedCount = 4;

void keep_half_of(std::span<float> coefficients, bool is_in_first_half) {
    const float factor = is_in_first_half ? 1.0f : 0.0f;
    for (size_t i = 0; i < 3 * kUsedCount; ++i)
        coefficients[3 * kUsedCount + i] = factor * coefficients[i];
    for (size_t i = 6 * kUsedCount; i < coefficients.size(); ++i) coefficients[i] = factor;
}

}  // namespace

void keep_half(ProbeEstimate& estimate, bool is_in_first_half) {
    constexpr size_t kSize = LightGroupLayout::kLayerSize;
    keep_half_of(std::span(&estimate.radiance.coefficients[0].x, kSize), is_in_first_half);
    const std::span groups(estimate.light_groups);
    for (size_t i = 0; i + kSize <= groups.size(); i += kSize)
        keep_half_of(groups.subspan(i, kSize), is_in_first_half);
}

glm::vec3 irradiance_on_normal(glm::dvec3 third_coefficient) {
    return glm::vec3(glm::max(third_coefficient / kY1, 0.0));
}

TexelLight texel_light(std::span<const double> coefficients, double sample_count,
                       glm::vec3 normal) {
    TETRALIGHT_ASSERT(coefficients.size() == 27, "nine coefficients of three colours");
    const glm::mat3 frame = frame_around(normal);
    TexelLight light;
    for (int channel = 0; channel < 3; ++channel) {
        const auto at = [&](size_t i) {
            return coefficients[3 * i + static_cast<size_t>(channel)] / sample_count;
        };
        const glm::dvec3 local = glm::dvec3(at(3), at(1), at(2)) / kY1;
        light.irradiance[channel] = static_cast<float>(std::max(0.0, local.z));
        light.flux[channel] = static_cast<float>(std::max(0.0, at(0) / kY0));
        light.vector[channel] = frame * glm::vec3(local);
    }
    return light;
}

TexelHalves texel_halves(std::span<const double> coefficients, double sample_count,
                         double first_half_count, glm::vec3 normal) {
    const double second_half_count = sample_count - first_half_count;
    if (!(first_half_count > 0.0 && second_half_count > 0.0)) {
        const TexelLight light = texel_light(coefficients, sample_count, normal);
        return {light, light};
    }
    std::array<double, 27> first{}, second{};
    for (size_t i = 0; i < 3 * kUsedCount; ++i) {
        first[i] = coefficients[3 * kUsedCount + i];
        second[i] = coefficients[i] - first[i];
    }
    return {texel_light(first, first_half_count, normal),
            texel_light(second, second_half_count, normal)};
}

}  // namespace tetralight
