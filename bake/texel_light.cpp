// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/texel_light.h>

#include <cstddef>
#include <glm/common.hpp>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

constexpr double kY0 = 0.28209479177387814, kY1 = 0.4886025119029199;

}  // namespace

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

}  // namespace tetralight
