// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shade.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {

glm::vec3 direct_light(const Light& light, glm::vec3 position, glm::vec3 normal) noexcept {
    return direct_light(illuminate(light, position), normal);
}

glm::vec3 direct_light(const Illumination& arriving, glm::vec3 normal) noexcept {
    const float cosine = std::max(0.0f, glm::dot(normal, arriving.to_light));
    return arriving.irradiance * (cosine * std::numbers::inv_pi_v<float>);
}

glm::vec3 subtract_shadow(glm::vec3 baked, glm::vec3 direct, float lit,
                          glm::vec3 shadow_color) noexcept {
    return glm::min(baked, glm::max(baked - direct * (1.0f - lit), shadow_color));
}

glm::vec3 shade_diffuse(glm::vec3 albedo, const PackedSh& probe_light, glm::vec3 normal,
                        glm::vec3 direct) noexcept {
    return albedo * (glm::max(sample_sh9(probe_light, normal), glm::vec3(0.0f)) + direct);
}

}  // namespace tetralight
