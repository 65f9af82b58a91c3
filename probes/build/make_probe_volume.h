// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/build/tetrahedralize.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Tetrahedralizes merged probes and lays out a volume without light: positions, cells, hull rays
/// and sources are filled, irradiance is empty.
[[nodiscard]] ProbeVolume make_probe_volume(const MergedProbes& probes);

/// The same over a tetrahedralization that is already there, of `probes.positions`.
[[nodiscard]] ProbeVolume make_probe_volume(const MergedProbes& probes, Tetrahedralization cells);

}  // namespace tetralight
