// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/distant_light.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include <tetralight/probes/sh.h>

namespace tetralight {
namespace {

/// Gauss-Legendre nodes and weights on [-1, 1]: exact to degree 7.
constexpr double kHeights[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                               0.8611363115940526};
constexpr double kWeights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                               0.3478548451374538};

/// Evenly spread azimuths are exact below this degree. Products of two functions of band 3 have 6.
constexpr int kAzimuthCount = 8;

}  // namespace

std::array<float, kDistantCoefficientCount> distant_basis(glm::vec3 direction) noexcept {
    // Band 3: √(35/32π), √(105/4π), √(21/32π), √(7/16π), as polynomials without signs.
    constexpr float kOuter = 0.59004358992664352f, kProduct = 2.8906114426405538f;
    constexpr float kInner = 0.45704579946446572f, kZonal = 0.37317633259011540f;
    const auto [x, y, z] = std::array{direction.x, direction.y, direction.z};
    std::array<float, kDistantCoefficientCount> basis;
    std::ranges::copy(sh_basis(direction), basis.begin());
    basis[9] = kOuter * y * (3 * x * x - y * y);
    basis[10] = kProduct * x * y * z;
    basis[11] = kInner * y * (5 * z * z - 1);
    basis[12] = kZonal * z * (5 * z * z - 3);
    basis[13] = kInner * x * (5 * z * z - 1);
    basis[14] = 0.5f * kProduct * z * (x * x - y * y);
    basis[15] = kOuter * x * (x * x - 3 * y * y);
    return basis;
}

DistantLight distant_sun(glm::vec3 to_light, glm::vec3 irradiance) noexcept {
    const auto basis = distant_basis(to_light);
    DistantLight light;
    for (int i = 0; i < kDistantCoefficientCount; ++i)
        light.coefficients[i] = irradiance * basis[i];
    return light;
}

glm::vec3 evaluate_radiance(const DistantLight& light, glm::vec3 direction) noexcept {
    const auto basis = distant_basis(direction);
    glm::vec3 sum(0.0f);
    for (int i = 0; i < kDistantCoefficientCount; ++i) sum += light.coefficients[i] * basis[i];
    return sum;
}

DistantLight rotate(const DistantLight& source, const glm::mat3& target_from_source) noexcept {
    const glm::dmat3 source_from_target = glm::transpose(glm::dmat3(target_from_source));
    std::array<glm::dvec3, kDistantCoefficientCount> sums{};
    for (int row = 0; row < 4; ++row) {
        const double z = kHeights[row], radius = std::sqrt(1.0 - z * z);
        const double weight = kWeights[row] * 2.0 * std::numbers::pi / kAzimuthCount;
        for (int column = 0; column < kAzimuthCount; ++column) {
            const double azimuth = 2.0 * std::numbers::pi * column / kAzimuthCount;
            const glm::dvec3 to(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
            const glm::dvec3 value(evaluate_radiance(source, glm::vec3(source_from_target * to)));
            const auto basis = distant_basis(glm::vec3(to));
            for (int i = 0; i < kDistantCoefficientCount; ++i) {
                sums[i] += value * (weight * static_cast<double>(basis[i]));
            }
        }
    }
    DistantLight target;
    for (int i = 0; i < kDistantCoefficientCount; ++i) target.coefficients[i] = glm::vec3(sums[i]);
    return target;
}

}  // namespace tetralight
