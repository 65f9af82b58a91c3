// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>

// Spherical harmonics of order 2 for light, and the two quantities that are easily confused made
// two types. Basis, order and signs: docs/conventions.md. Formulas: Ramamoorthi & Hanrahan 2001,
// "An Efficient Representation for Irradiance Environment Maps".
//
//     RadianceSh radiance = project_radiance(directions, values);   // what arrives
//     IrradianceSh irradiance = irradiance_from_radiance(radiance); // what a surface gathers
//     glm::vec3 exitant = albedo / pi * evaluate_irradiance(irradiance, normal);

namespace tetralight {

inline constexpr int kShCoefficientCount = 9;

/// Nine RGB coefficients, index l(l+1)+m, of a function on the sphere; `Quantity` keeps apart what
/// the function means. Linear: sums and scalings of light are sums and scalings of coefficients.
template <class Quantity>
struct ShL2 {
    std::array<glm::vec3, kShCoefficientCount> coefficients{};

    ShL2& operator+=(const ShL2& other) noexcept {
        for (int i = 0; i < kShCoefficientCount; ++i) coefficients[i] += other.coefficients[i];
        return *this;
    }

    ShL2& operator*=(float factor) noexcept {
        for (glm::vec3& coefficient : coefficients) coefficient *= factor;
        return *this;
    }

    friend ShL2 operator+(ShL2 a, const ShL2& b) noexcept { return a += b; }

    friend ShL2 operator*(ShL2 a, float factor) noexcept { return a *= factor; }

    friend ShL2 operator*(float factor, ShL2 a) noexcept { return a *= factor; }

    bool operator==(const ShL2&) const = default;
};

/// Radiance L that arrives from each direction: L_i = ∫ L(ω) Y_i(ω) dω.
using RadianceSh = ShL2<struct RadianceQuantity>;

/// Irradiance E of a surface with each normal, not divided by π: E(n) = Σ E_i Y_i(n), in the
/// lights' own unit.
using IrradianceSh = ShL2<struct IrradianceQuantity>;

static_assert(sizeof(IrradianceSh) == 108 && std::is_trivially_copyable_v<IrradianceSh>);
static_assert(!std::is_convertible_v<RadianceSh, IrradianceSh>);

/// The nine basis functions Y_i at a unit direction: real, orthonormal, all-positive polynomials.
[[nodiscard]] std::array<float, kShCoefficientCount> sh_basis(glm::vec3 direction) noexcept;

/// Running sum of radiance samples, in double so that a million of them lose nothing.
struct RadianceShSum {
    std::array<glm::dvec3, kShCoefficientCount> coefficients{};

    /// Adds radiance · Y(direction).
    void add(glm::vec3 direction, glm::vec3 radiance) noexcept;
    RadianceShSum& operator+=(const RadianceShSum& other) noexcept;
};

/// The sum times `weight`: solid angle per sample, 4π/N for N uniform directions.
[[nodiscard]] RadianceSh radiance_from_sum(const RadianceShSum& sum, double weight) noexcept;

/// Projects samples at directions that are uniform on the sphere. Precondition: same lengths.
[[nodiscard]] RadianceSh project_radiance(std::span<const glm::vec3> directions,
                                          std::span<const glm::vec3> radiance) noexcept;

/// Light of one infinitely distant source in a unit direction, whose irradiance on a surface that
/// faces it is `irradiance`: L_i = irradiance · Y_i(direction).
[[nodiscard]] RadianceSh radiance_from_directional_light(glm::vec3 to_light,
                                                         glm::vec3 irradiance) noexcept;

/// The same radiance from everywhere.
[[nodiscard]] RadianceSh constant_radiance(glm::vec3 radiance) noexcept;

/// Convolution with the clamped cosine: E_i = A_l L_i, A = π, 2π/3, π/4.
[[nodiscard]] IrradianceSh irradiance_from_radiance(const RadianceSh& radiance) noexcept;

/// Inverse of `irradiance_from_radiance`.
[[nodiscard]] RadianceSh radiance_from_irradiance(const IrradianceSh& irradiance) noexcept;

/// Band-limited radiance from a unit direction; can be negative where the light rings.
[[nodiscard]] glm::vec3 evaluate_radiance(const RadianceSh& radiance, glm::vec3 direction) noexcept;

/// Irradiance of a surface with the given unit normal; can be negative where the light rings.
[[nodiscard]] glm::vec3 evaluate_irradiance(const IrradianceSh& irradiance,
                                            glm::vec3 normal) noexcept;

/// Rotates the light: rotated(R·d) = original(d). `target_from_source` is
/// orthonormal; a reflection is allowed. Exact up to rounding for every rotation.
[[nodiscard]] RadianceSh rotate(const RadianceSh& source,
                                const glm::mat3& target_from_source) noexcept;
[[nodiscard]] IrradianceSh rotate(const IrradianceSh& source,
                                  const glm::mat3& target_from_source) noexcept;

}  // namespace tetralight
