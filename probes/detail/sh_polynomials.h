// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat3x3.hpp>

#include <tetralight/probes/sh.h>

// The basis functions of probes/sh.h as the polynomials that they are.

namespace tetralight::detail {

// K_lm of the orthonormal basis: sqrt(1/4π), sqrt(3/4π), sqrt(15/4π), sqrt(5/16π), sqrt(15/16π).
inline constexpr double kBand0 = 0.28209479177387814;
inline constexpr double kBand1 = 0.48860251190291992;
inline constexpr double kBand2 = 1.09254843059207907;
inline constexpr double kBand2Zonal = 0.31539156525252001;
inline constexpr double kBand2Square = 0.54627421529603953;

/// Nine coefficients of one colour channel.
using ShChannel = std::array<double, kShCoefficientCount>;

template <class Quantity>
[[nodiscard]] ShChannel channel_of(const ShL2<Quantity>& sh, int channel) {
    ShChannel values;
    for (int i = 0; i < kShCoefficientCount; ++i) values[i] = sh.coefficients[i][channel];
    return values;
}

/// Band 2 as the quadratic form dᵀ Q d: symmetric and traceless, so that Q turns as R Q Rᵀ.
[[nodiscard]] inline glm::dmat3 quadratic_form(const ShChannel& c) {
    const double xy = kBand2 / 2 * c[4];
    const double yz = kBand2 / 2 * c[5];
    const double xz = kBand2 / 2 * c[7];
    const double square = kBand2Square * c[8];
    const double zonal = kBand2Zonal * c[6];
    return {square - zonal, xy, xz, xy, -square - zonal, yz, xz, yz, 2 * zonal};
}

}  // namespace tetralight::detail
