// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

// Irradiance on normals near that of a lightmap's surface, as normal maps give, from the light of a
// texel: φ = ∫ L dω and v = ∫ L ω dω over the hemisphere of its base normal n0. The light is taken
// as a uniform hemisphere about n0 with the flux a, and the rest from one direction:
//
//     v = (a / 2) n0 + w,  |w| = φ − a,  so that  ¾ a² − (2φ − n0 · v) a + φ² − |v|² = 0
//     E(n) = a (1 + n · n0) / 4 + max(0, n · w)
//
// E(n0) = n0 · v is exact, as are a uniform sky and a single small light for each n. GPU twin:
// runtime/shaders/lightmap.glsl.

namespace tetralight {

/// Y of linear RGB with the primaries of Rec. 709 is its dot product with these.
inline constexpr glm::vec3 kLuminanceWeights{0.2126f, 0.7152f, 0.0722f};

/// The part of the flux that comes as a uniform hemisphere about the base normal, 0 to 1, for
/// u = v / φ with |u| ≤ 1. Light that leaves `base_normal` dark has none.
[[nodiscard]] inline float uniform_part(const glm::vec3& u, const glm::vec3& base_normal) noexcept {
    const float cosine = glm::dot(u, base_normal);
    const float b = 2.0f - cosine, c = std::max(0.0f, 1.0f - glm::dot(u, u));
    const float root = 2.0f * c / (b + std::sqrt(std::max(0.0f, b * b - 3.0f * c)));
    return std::clamp(root, 0.0f, std::max(0.0f, 2.0f * cosine));
}

/// E(n) / φ for u = v / φ with |u| ≤ 1, of unit normals. Not negative, at most 1.
[[nodiscard]] inline float irradiance_of_unit_flux(const glm::vec3& u, const glm::vec3& base_normal,
                                                   const glm::vec3& normal) noexcept {
    const float uniform = uniform_part(u, base_normal);
    const float from_all = 0.25f * uniform * (1.0f + glm::dot(normal, base_normal));
    const glm::vec3 rest = u - 0.5f * uniform * base_normal;
    return std::max(0.0f, from_all) + std::max(0.0f, glm::dot(normal, rest));
}

/// Irradiance of one channel on a unit normal, in the unit of its flux. Rounding and filters may
/// make v longer than φ: then φ is taken as |v|.
[[nodiscard]] inline float directional_irradiance(float flux, const glm::vec3& vector,
                                                  const glm::vec3& base_normal,
                                                  const glm::vec3& normal) noexcept {
    if (!(flux > 0.0f)) return std::max(0.0f, glm::dot(normal, vector));
    const glm::vec3 u = vector / flux;
    const float length = std::max(1.0f, glm::length(u));
    return flux * length * irradiance_of_unit_flux(u / length, base_normal, normal);
}

/// The direction of light as one vector for all channels: u = v̄ / φ̄ of the luminances of φ and v,
/// |u| ≤ 1. 0 without light.
[[nodiscard]] inline glm::vec3 mono_vector(const glm::vec3& flux,
                                           const std::array<glm::vec3, 3>& vectors) noexcept {
    const glm::vec3 vector = kLuminanceWeights.x * vectors[0] + kLuminanceWeights.y * vectors[1] +
                             kLuminanceWeights.z * vectors[2];
    const float light = std::max(glm::dot(kLuminanceWeights, flux), glm::length(vector));
    return light > 0.0f ? vector / light : glm::vec3(0.0f);
}

/// What E(n0) of each channel is multiplied with to give E(n), with one direction for all channels:
/// (R(n) + ε) / (R(n0) + ε) of R = `irradiance_of_unit_flux`. ε = 1/256 keeps grazing light of
/// rounded u finite. 1 on the base normal, and where u = 0.
[[nodiscard]] inline float mono_ratio(const glm::vec3& u, const glm::vec3& base_normal,
                                      const glm::vec3& normal) noexcept {
    constexpr float kLeast = 1.0f / 256.0f;
    return (irradiance_of_unit_flux(u, base_normal, normal) + kLeast) /
           (irradiance_of_unit_flux(u, base_normal, base_normal) + kLeast);
}

}  // namespace tetralight
