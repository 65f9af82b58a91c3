// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/sh_minimum.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <tetralight/probes/detail/sh_polynomials.h>
#include <tetralight/probes/detail/symmetric_eigen.h>

namespace tetralight {
namespace {

/// Σ slopeᵢ² / (curvatureᵢ − λ)^power, for λ below every curvature.
double secular_sum(const glm::dvec3& curvature, const glm::dvec3& slope, double lambda, int power) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        if (slope[i] == 0.0) continue;
        const double gap = curvature[i] - lambda;
        sum += slope[i] / gap * (power == 2 ? slope[i] / gap : slope[i]);
    }
    return sum;
}

/// Minimum of xᵀ diag(curvature) x + 2 slopeᵀx over |x| = 1. Its dual, the maximum over λ ≤ min
/// curvature of λ − Σ slope² / (curvature − λ), has no gap (Moré & Sorensen 1983) and bounds it
/// from below at every λ, so that even the hard case, in which x is not unique, needs no care.
double minimum_on_sphere(const glm::dvec3& curvature, const glm::dvec3& slope) {
    const double least = std::min({curvature.x, curvature.y, curvature.z});
    double low = least - glm::length(slope);  // there Σ slope² / (curvature − λ)² ≤ 1
    double high = least;
    if (!(low < least)) return least;  // the slope is lost in rounding
    for (int step = 0; step < 64; ++step) {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) break;
        (secular_sum(curvature, slope, middle, 2) <= 1.0 ? low : high) = middle;
    }
    return low - secular_sum(curvature, slope, low, 1);
}

double minimum(const detail::ShChannel& c) {
    const detail::SymmetricEigen form = detail::symmetric_eigen(detail::quadratic_form(c));
    const glm::dvec3 slope = 0.5 * detail::kBand1 * glm::dvec3(c[3], c[1], c[2]);
    return detail::kBand0 * c[0] +
           minimum_on_sphere(form.values, glm::transpose(form.axes) * slope);
}

}  // namespace

glm::dvec3 minimum_irradiance(const IrradianceSh& irradiance) noexcept {
    return {minimum(detail::channel_of(irradiance, 0)), minimum(detail::channel_of(irradiance, 1)),
            minimum(detail::channel_of(irradiance, 2))};
}

}  // namespace tetralight
