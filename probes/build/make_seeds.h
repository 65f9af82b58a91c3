// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Makes the seeds of a volume without a seed grid, where walks without a hint start: every eighth
/// probe with one of its cells, along a Hilbert curve. Their density follows that of the probes and
/// does not depend on the bounding box. Precondition: positions and cells are complete.
void make_seeds(ProbeVolume& volume);

}  // namespace tetralight
