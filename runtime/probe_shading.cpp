// SPDX-License-Identifier: Apache-2.0
#include "runtime/probe_shading.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace tetralight {

PackedSh4 first_bands(const PackedSh& sh) noexcept {
    const auto without_third = [](glm::vec4 sha, const glm::vec4& shb) {
        sha.w += shb.z * (1.0f / 3.0f);
        return sha;
    };
    return {without_third(sh.sha_r, sh.shb_r), without_third(sh.sha_g, sh.shb_g),
            without_third(sh.sha_b, sh.shb_b)};
}

glm::vec3 sample_sh4(const PackedSh4& sh, glm::vec3 normal) noexcept {
    const glm::vec4 linear(normal, 1.0f);
    return {glm::dot(sh.sha_r, linear), glm::dot(sh.sha_g, linear), glm::dot(sh.sha_b, linear)};
}

PackedSh add_layer(const PackedSh& sum, const PackedSh& layer, glm::vec3 weight) noexcept {
    return {sum.sha_r + layer.sha_r * weight.x,
            sum.sha_g + layer.sha_g * weight.y,
            sum.sha_b + layer.sha_b * weight.z,
            sum.shb_r + layer.shb_r * weight.x,
            sum.shb_g + layer.shb_g * weight.y,
            sum.shb_b + layer.shb_b * weight.z,
            glm::vec4(glm::vec3(sum.shc) + glm::vec3(layer.shc) * weight, 1.0f)};
}

float probe_occlusion(const glm::vec4& occlusion, int channel) noexcept {
    return channel >= 0 && channel < 4 ? occlusion[channel] : 1.0f;
}

float mix_occlusion(float shadow, float occlusion, float fade) noexcept {
    return std::min(shadow, occlusion) * (1.0f - fade) + occlusion * fade;
}

glm::vec3 instance_normal(glm::vec3 x_axis, glm::vec3 y_axis, glm::vec3 z_axis,
                          glm::vec3 normal) noexcept {
    // The cofactors of the transform: its inverse transpose times its determinant.
    const glm::vec3 turned = glm::cross(y_axis, z_axis) * normal.x +
                             glm::cross(z_axis, x_axis) * normal.y +
                             glm::cross(x_axis, y_axis) * normal.z;
    const float sign = glm::dot(x_axis, glm::cross(y_axis, z_axis)) < 0.0f ? -1.0f : 1.0f;
    const float length = glm::length(turned);
    return length > 0.0f ? turned * (sign / length) : normal;
}

}  // namespace tetralight
