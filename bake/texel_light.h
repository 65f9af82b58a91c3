// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace tetralight {

/// The light that arrives at a texel from the hemisphere of its normal, in world axes.
struct TexelLight {
    glm::vec3 irradiance{0.0f};  ///< on the normal of the texel
    glm::vec3 flux{0.0f};        ///< φ = ∫ L dω
    glm::mat3 vector{0.0f};      ///< v = ∫ L ω dω, a column a colour channel

    TexelLight& operator+=(const TexelLight& other) {
        irradiance += other.irradiance;
        flux += other.flux;
        vector += other.vector;
        return *this;
    }

    friend TexelLight operator*(const TexelLight& light, float factor) {
        return {light.irradiance * factor, light.flux * factor, light.vector * factor};
    }

    /// The largest magnitude of all values.
    [[nodiscard]] float largest() const {
        float largest = 0.0f;
        for (int channel = 0; channel < 3; ++channel) {
            largest = std::max({largest, irradiance[channel], flux[channel]});
            for (int axis = 0; axis < 3; ++axis)
                largest = std::max(largest, std::abs(vector[channel][axis]));
        }
        return largest;
    }
};

/// Irradiance on the normal of a texel, from the third coefficient of its radiance in the frame of
/// the normal (`estimate_texel`).
[[nodiscard]] glm::vec3 irradiance_on_normal(glm::dvec3 third_coefficient);

/// From the sum of coefficients of `sample_count` samples in the frame of the normal
/// (`estimate_texel`): 27 values, colour by colour for each coefficient.
[[nodiscard]] TexelLight texel_light(std::span<const double> coefficients, double sample_count,
                                     glm::vec3 normal);

}  // namespace tetralight
