// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "probes/build/merge.h"
#include "probes/build/tetrahedralize.h"
#include "probes/probe_volume.h"

namespace tetralight {

/// Tetrahedralizes merged probes and lays out a volume without light: positions, cells, hull rays
/// and sources are filled, irradiance is empty.
[[nodiscard]] ProbeVolume make_probe_volume(const MergedProbes& probes);

/// The same over a tetrahedralization that is already there, of `probes.positions`.
[[nodiscard]] ProbeVolume make_probe_volume(const MergedProbes& probes, Tetrahedralization cells);

}  // namespace tetralight
