// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/sh.h>

#include <glm/matrix.hpp>
#include <numbers>

#include <tetralight/base/contract.h>
#include <tetralight/probes/detail/sh_polynomials.h>

namespace tetralight {
namespace {

using detail::kBand0;
using detail::kBand1;
using detail::kBand2;
using detail::kBand2Square;
using detail::kBand2Zonal;
using detail::quadratic_form;
using detail::ShChannel;

using Basis = std::array<float, kShCoefficientCount>;

/// A_l of each coefficient (Ramamoorthi & Hanrahan 2001, eq. 8).
constexpr Basis kClampedCosine = [] {
    constexpr double pi = std::numbers::pi;
    constexpr auto band1 = static_cast<float>(2 * pi / 3);
    constexpr auto band2 = static_cast<float>(pi / 4);
    return Basis{static_cast<float>(pi), band1, band1, band1, band2, band2, band2, band2, band2};
}();

template <class Target, class Source>
Target scale_bands(const Source& source, const Basis& factors) {
    Target target;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        target.coefficients[i] = source.coefficients[i] * factors[i];
    }
    return target;
}

template <class Sh>
glm::vec3 evaluate(const Sh& sh, glm::vec3 direction) {
    const Basis basis = sh_basis(direction);
    glm::vec3 value(0.0f);
    for (int i = 0; i < kShCoefficientCount; ++i) value += sh.coefficients[i] * basis[i];
    return value;
}

ShChannel rotate_channel(const ShChannel& source, const glm::dmat3& rotation) {
    const glm::dvec3 linear = rotation * glm::dvec3(source[3], source[1], source[2]);
    const glm::dmat3 form = rotation * quadratic_form(source) * glm::transpose(rotation);
    return {source[0],
            linear.y,
            linear.z,
            linear.x,
            form[0][1] * 2 / kBand2,
            form[1][2] * 2 / kBand2,
            form[2][2] / (2 * kBand2Zonal),
            form[0][2] * 2 / kBand2,
            (form[0][0] - form[1][1]) / (2 * kBand2Square)};
}

template <class Sh>
Sh rotate_sh(const Sh& source, const glm::mat3& target_from_source) {
    const glm::dmat3 rotation(target_from_source);
    Sh target;
    for (int channel = 0; channel < 3; ++channel) {
        const ShChannel values = rotate_channel(detail::channel_of(source, channel), rotation);
        for (int i = 0; i < kShCoefficientCount; ++i) {
            target.coefficients[i][channel] = static_cast<float>(values[i]);
        }
    }
    return target;
}

}  // namespace

Basis sh_basis(glm::vec3 direction) noexcept {
    const auto [x, y, z] = std::array{direction.x, direction.y, direction.z};
    constexpr auto band0 = static_cast<float>(kBand0);
    constexpr auto band1 = static_cast<float>(kBand1);
    constexpr auto band2 = static_cast<float>(kBand2);
    return {band0,
            band1 * y,
            band1 * z,
            band1 * x,
            band2 * x * y,
            band2 * y * z,
            static_cast<float>(kBand2Zonal) * (3 * z * z - 1),
            band2 * x * z,
            static_cast<float>(kBand2Square) * (x * x - y * y)};
}

void RadianceShSum::add(glm::vec3 direction, glm::vec3 radiance) noexcept {
    const Basis basis = sh_basis(direction);
    const glm::dvec3 value(radiance);
    for (int i = 0; i < kShCoefficientCount; ++i) {
        coefficients[i] += value * static_cast<double>(basis[i]);
    }
}

RadianceShSum& RadianceShSum::operator+=(const RadianceShSum& other) noexcept {
    for (int i = 0; i < kShCoefficientCount; ++i) coefficients[i] += other.coefficients[i];
    return *this;
}

RadianceSh radiance_from_sum(const RadianceShSum& sum, double weight) noexcept {
    RadianceSh radiance;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        radiance.coefficients[i] = glm::vec3(sum.coefficients[i] * weight);
    }
    return radiance;
}

RadianceSh project_radiance(std::span<const glm::vec3> directions,
                            std::span<const glm::vec3> radiance) noexcept {
    TETRALIGHT_ASSERT(directions.size() == radiance.size(), "one radiance for each direction");
    RadianceShSum sum;
    for (size_t i = 0; i < directions.size(); ++i) sum.add(directions[i], radiance[i]);
    if (directions.empty()) return {};
    return radiance_from_sum(sum, 4 * std::numbers::pi / static_cast<double>(directions.size()));
}

RadianceSh radiance_from_directional_light(glm::vec3 to_light, glm::vec3 irradiance) noexcept {
    const Basis basis = sh_basis(to_light);
    RadianceSh radiance;
    for (int i = 0; i < kShCoefficientCount; ++i) radiance.coefficients[i] = irradiance * basis[i];
    return radiance;
}

RadianceSh constant_radiance(glm::vec3 radiance) noexcept {
    RadianceSh sh;
    sh.coefficients[0] = radiance * static_cast<float>(4 * std::numbers::pi * kBand0);
    return sh;
}

IrradianceSh irradiance_from_radiance(const RadianceSh& radiance) noexcept {
    return scale_bands<IrradianceSh>(radiance, kClampedCosine);
}

RadianceSh radiance_from_irradiance(const IrradianceSh& irradiance) noexcept {
    Basis inverse;
    for (int i = 0; i < kShCoefficientCount; ++i) inverse[i] = 1 / kClampedCosine[i];
    return scale_bands<RadianceSh>(irradiance, inverse);
}

glm::vec3 evaluate_radiance(const RadianceSh& radiance, glm::vec3 direction) noexcept {
    return evaluate(radiance, direction);
}

glm::vec3 evaluate_irradiance(const IrradianceSh& irradiance, glm::vec3 normal) noexcept {
    return evaluate(irradiance, normal);
}

RadianceSh rotate(const RadianceSh& source, const glm::mat3& target_from_source) noexcept {
    return rotate_sh(source, target_from_source);
}

IrradianceSh rotate(const IrradianceSh& source, const glm::mat3& target_from_source) noexcept {
    return rotate_sh(source, target_from_source);
}

}  // namespace tetralight
