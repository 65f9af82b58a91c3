// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/bake/probe_estimator.h>

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

/// The light of a texel by two halves of its samples, which are independent.
using TexelHalves = std::array<TexelLight, 2>;

/// Lightmaps need no coefficients of band 2. Those of the texels that `bake_accumulators` bakes
/// keep the light of one half of the samples instead: coefficients 4 to 7 are coefficients 0 to 3
/// of the estimates of the first half of each round, and 0 of all others; coefficient 8 is 1 or 0,
/// so that its sum is the number of their samples. The same for each layer.
void keep_half(ProbeEstimate& estimate, bool is_in_first_half);

/// Irradiance on the normal of a texel, from the third coefficient of its radiance in the frame of
/// the normal (`estimate_texel`).
[[nodiscard]] glm::vec3 irradiance_on_normal(glm::dvec3 third_coefficient);

/// From the sum of coefficients of `sample_count` samples in the frame of the normal
/// (`estimate_texel`): 27 values, colour by colour for each coefficient.
[[nodiscard]] TexelLight texel_light(std::span<const double> coefficients, double sample_count,
                                     glm::vec3 normal);

/// The same by halves (`keep_half`). `first_half_count`: coefficient 8 of the sum of all light.
/// Both have the light of all samples if a half has none.
[[nodiscard]] TexelHalves texel_halves(std::span<const double> coefficients, double sample_count,
                                       double first_half_count, glm::vec3 normal);

}  // namespace tetralight
