// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/sh.h>

// Norms of irradiance, to compare two lights: over the 26 normals towards the faces, edges and
// corners of a cube, and the three colour channels.

namespace tetralight {

/// Mean square of an irradiance, or of a difference of two.
[[nodiscard]] double mean_square(const IrradianceSh& light);

/// Mean irradiance.
[[nodiscard]] double mean_irradiance(const IrradianceSh& light);

}  // namespace tetralight
