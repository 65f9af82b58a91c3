// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/sh.h>

namespace tetralight::bench {

/// Irradiance, the mean over 26 normals and the colour channels.
[[nodiscard]] double mean_irradiance(const RadianceSh& light);

/// Root mean square error of irradiance over 26 normals, as a fraction of the mean irradiance. 0 if
/// no light arrives.
[[nodiscard]] double relative_rmse(const RadianceSh& a, const RadianceSh& reference);

/// Root mean square error of irradiance over all normals, as a fraction of the root mean square of
/// irradiance: the quantity that error bars predict (`ProbeAccumulator::standard_error`).
[[nodiscard]] double parseval_error(const RadianceSh& a, const RadianceSh& reference);

}  // namespace tetralight::bench
