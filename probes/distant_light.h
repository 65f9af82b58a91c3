// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <type_traits>

// Light from infinitely far away as spherical harmonics of order 3: a sky, a sun. One band more
// than probes have, because a probe that sees only a part of the sky needs it.

namespace tetralight {

inline constexpr int kDistantCoefficientCount = 16;

/// The 16 basis functions of bands 0 to 3 at a unit direction; the first nine are `sh_basis`.
[[nodiscard]] std::array<float, kDistantCoefficientCount> distant_basis(
    glm::vec3 direction) noexcept;

/// Radiance from each direction: L_i = ∫ L(ω) Y_i(ω) dω, index l(l+1)+m.
struct DistantLight {
    std::array<glm::vec3, kDistantCoefficientCount> coefficients{};

    DistantLight& operator+=(const DistantLight& other) noexcept {
        for (size_t i = 0; i < coefficients.size(); ++i) coefficients[i] += other.coefficients[i];
        return *this;
    }

    DistantLight& operator*=(float factor) noexcept {
        for (glm::vec3& coefficient : coefficients) coefficient *= factor;
        return *this;
    }

    bool operator==(const DistantLight&) const = default;
};

static_assert(sizeof(DistantLight) == 192 && std::is_trivially_copyable_v<DistantLight>);

/// A sun in a unit direction, whose irradiance on a surface that faces it is `irradiance`.
[[nodiscard]] DistantLight distant_sun(glm::vec3 to_light, glm::vec3 irradiance) noexcept;

/// Radiance from a unit direction, as far as four bands hold it; can be negative.
[[nodiscard]] glm::vec3 evaluate_radiance(const DistantLight& light, glm::vec3 direction) noexcept;

/// Rotates the light: rotated(R·d) = original(d). `target_from_source` is orthonormal. Exact up to
/// rounding: the rotated function is projected again by a quadrature that is exact for it.
[[nodiscard]] DistantLight rotate(const DistantLight& source,
                                  const glm::mat3& target_from_source) noexcept;

}  // namespace tetralight
