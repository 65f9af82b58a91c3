// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// What errors of light are relative to.
enum class ErrorKind : uint8_t {
    Absolute,  ///< the mean irradiance of the scene
    Relative,  ///< the irradiance at the place
    Mixed,     ///< the geometric mean of both: differences of square roots, close to what pictures
               ///< show after exposure and encoding
};

/// Makes errors of light comparable between places. At places darker than a twentieth of the mean
/// they count as at a twentieth.
class ErrorScale {
  public:
    ErrorScale() = default;

    /// `mean`: the mean irradiance of the scene; 0 = all is dark, and errors have no weight.
    ErrorScale(ErrorKind kind, double mean) : kind_(kind), mean_(mean) {}

    /// The square of the error of a difference from the true light.
    [[nodiscard]] double square(const IrradianceSh& difference, const IrradianceSh& truth) const {
        return mean_square(difference) * weight(truth);
    }

    /// Multiplies mean squares of differences from this light.
    [[nodiscard]] double weight(const IrradianceSh& truth) const {
        constexpr double kDarkest = 0.05;
        if (!(mean_ > 0.0)) return 0.0;
        const double here = std::max(mean_irradiance(truth), kDarkest * mean_);
        switch (kind_) {
            case ErrorKind::Absolute:
                return 1.0 / (mean_ * mean_);
            case ErrorKind::Relative:
                return 1.0 / (here * here);
            case ErrorKind::Mixed:
                return 1.0 / (here * mean_);
        }
        return 0.0;
    }

  private:
    ErrorKind kind_ = ErrorKind::Mixed;
    double mean_ = 0.0;
};

}  // namespace tetralight
