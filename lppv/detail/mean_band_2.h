// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/sh.h>

namespace tetralight::detail {

inline constexpr int kFirstOfBand2 = 4;

/// The mean of band 2 over a grid; bands 0 and 1 are 0. Summed in double, in order.
[[nodiscard]] IrradianceSh mean_band_2(std::span<const IrradianceSh> irradiance) noexcept;

}  // namespace tetralight::detail
