// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/dering.h>

#include <tetralight/probes/detail/sh_polynomials.h>
#include <tetralight/probes/sh_minimum.h>

namespace tetralight {
namespace {

/// E(n) = mean + w · (E(n) − mean) is least where E is, and 0 there for w = mean / (mean − least).
float mildest_factor(double mean, double least) {
    // More than what rounding of the scaled coefficients to float can take away, which is half a
    // step of at most eight times the mean.
    constexpr double kMargin = 1.0 - 0x1p-20;
    if (least >= 0.0) return 1.0f;
    if (!(mean > 0.0)) return 0.0f;
    return static_cast<float>(kMargin * mean / (mean - least));
}

IrradianceSh scale_bands(const IrradianceSh& source, const glm::vec3& band1,
                         const glm::vec3& band2) {
    IrradianceSh target = source;
    for (int i = 1; i < kShCoefficientCount; ++i) target.coefficients[i] *= i < 4 ? band1 : band2;
    return target;
}

}  // namespace

IrradianceSh dering(const IrradianceSh& irradiance, DeringWindow window) noexcept {
    if (window == DeringWindow::Hann) {
        return scale_bands(irradiance, glm::vec3(0.75f), glm::vec3(0.25f));
    }
    if (window == DeringWindow::Lanczos) {
        return scale_bands(irradiance, glm::vec3(0.82699334f), glm::vec3(0.41349667f));
    }
    const glm::dvec3 least = minimum_irradiance(irradiance);
    glm::vec3 factor(1.0f);
    for (int channel = 0; channel < 3; ++channel) {
        const double mean = detail::kBand0 * irradiance.coefficients[0][channel];
        factor[channel] = mildest_factor(mean, least[channel]);
    }
    return scale_bands(irradiance, factor, factor);
}

}  // namespace tetralight
