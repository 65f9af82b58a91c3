// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/probe_shading.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
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

glm::vec3 dominant_direction(const PackedSh& sh) noexcept {
    const glm::vec4 sum = sh.sha_r * 0.2126f + sh.sha_g * 0.7152f + sh.sha_b * 0.0722f;
    const glm::vec3 direction(sum);
    const float square = glm::dot(direction, direction);
    return square > 0.0f ? direction * (1.0f / std::sqrt(square)) : glm::vec3(0.0f, 1.0f, 0.0f);
}

glm::vec3 dominant_irradiance(const PackedSh& sh, glm::vec3 direction) noexcept {
    const glm::vec4 along(direction, 0.0f);
    const glm::vec3 share(glm::dot(sh.sha_r, along), glm::dot(sh.sha_g, along),
                          glm::dot(sh.sha_b, along));
    return glm::max(share, glm::vec3(0.0f)) * 6.2831853f;
}

glm::vec3 specular_reflection(glm::vec3 normal, glm::vec3 to_light, glm::vec3 to_eye, glm::vec3 f0,
                              float roughness) noexcept {
    const glm::vec3 between = to_light + to_eye;
    const float square = glm::dot(between, between);
    const float light_cosine = glm::dot(normal, to_light);
    if (!(light_cosine > 0.0f) || !(square > 0.0f)) return glm::vec3(0.0f);
    const glm::vec3 halfway = between * (1.0f / std::sqrt(square));
    const float eye_cosine = std::max(glm::dot(normal, to_eye), 0.0001f);
    const float half_cosine = glm::dot(normal, halfway);
    const float a = std::max(roughness * roughness, 0.002f);
    const float a2 = a * a;
    const float spread = half_cosine * half_cosine * (a2 - 1.0f) + 1.0f;
    const float facets = a2 / (3.1415927f * spread * spread);
    const float masking = light_cosine * std::sqrt(eye_cosine * eye_cosine * (1.0f - a2) + a2) +
                          eye_cosine * std::sqrt(light_cosine * light_cosine * (1.0f - a2) + a2);
    const float grazing = 1.0f - std::max(glm::dot(to_eye, halfway), 0.0f);
    const float grazing_2 = grazing * grazing;
    const glm::vec3 mirrored = f0 + (glm::vec3(1.0f) - f0) * (grazing_2 * grazing_2 * grazing);
    return mirrored * (facets * 0.5f / masking * light_cosine);
}

}  // namespace tetralight
