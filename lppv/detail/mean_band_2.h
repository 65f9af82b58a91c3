// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/sh.h>

namespace tetralight::detail {

inline constexpr int kFirstOfBand2 = 4;

/// The mean of band 2 over a grid, summed in double and in order. Bands 0 and 1 of the result are
/// 0.
[[nodiscard]] IrradianceSh mean_band_2(std::span<const IrradianceSh> irradiance) noexcept;

}  // namespace tetralight::detail
