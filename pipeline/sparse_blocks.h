// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lppv/sparse_lppv.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Adds the blocks within `reach` metres of a probe, along each axis. Errors of
/// `SparseBlocks::add_box`.
[[nodiscard]] Status add_blocks_near_probes(const ProbeVolumeView& volume, double reach,
                                            SparseBlocks& blocks);

/// Adds the blocks within `reach` metres of the scene's triangles, static or not.
[[nodiscard]] Status add_blocks_near_surfaces(const Scene& scene, double reach,
                                              SparseBlocks& blocks);

}  // namespace tetralight
