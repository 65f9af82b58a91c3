// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include <tetralight/probes/build/merge.h>

namespace tetralight::detail {

/// Welds positions, one for each of `merged.sources`: sets the probe of each source, the positions
/// of probes along a Hilbert curve, and the weld radius.
void weld_sources(std::span<const glm::dvec3> positions, double tolerance, MergedProbes& merged);

}  // namespace tetralight::detail
