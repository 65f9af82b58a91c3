// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/probes/sh.h>

// Three bands cannot represent a small bright light: the reconstructed irradiance rings around the
// true one, and is negative on the far side, by 4 % of its peak for a single distant light. A
// window scales the bands down. Windows: Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks"; the
// weakest sufficient window of each probe: Sloan 2017, "Deringing Spherical Harmonics".

namespace tetralight {

enum class DeringWindow : uint8_t {
    /// Bands 1 and 2 times the largest w ≤ 1 for which no irradiance is negative, one w a channel.
    /// Light that does not ring keeps its bits.
    Mildest,
    /// Band l times (1 + cos(π l / 3)) / 2 and sin(π l / 3) / (π l / 3): the same for every light,
    /// whether it rings or not. Irradiance may remain negative.
    Hann,
    Lanczos,
};

/// The light with less ringing. Its mean over all normals (coefficient 0) keeps its bits.
///
/// After `Mildest` E(n) ≥ 0 for every n, and so for every blend with weights ≥ 0 of such lights;
/// if the mean is not positive, only the mean remains.
[[nodiscard]] IrradianceSh dering(const IrradianceSh& irradiance,
                                  DeringWindow window = DeringWindow::Mildest) noexcept;

}  // namespace tetralight
