// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// The warning of a bake without any light. `place`: what it bakes, "probe" or "texel".
[[nodiscard]] std::string no_light_warning(const char* place);

/// Adds a line for each group with probes that no light reaches, as inside hollow walls, or one
/// line if no probe of the volume has light. Adds nothing below 64 samples a probe, which may miss
/// an opening. Precondition: one irradiance a probe.
void add_dark_warnings(const MergedProbes& merged, std::span<const IrradianceSh> irradiance,
                       uint32_t sample_count, std::vector<std::string>& warnings);

}  // namespace tetralight
