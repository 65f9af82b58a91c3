// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/bake_probes.h>
#include <tetralight/pipeline/reused_probes.h>

namespace tetralight {

/// Gives probes the light that they take: all arrays of one a probe that a bake fills, layers
/// included. It is as the end of a bake leaves it, and so is taken again after what changes probes.
void take_reused(const ReusedProbes& reused, ProbeVolume& volume);

/// Their standard errors.
void take_reused(const ReusedProbes& reused, BakedProbes& baked);

}  // namespace tetralight
