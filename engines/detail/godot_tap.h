// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/engines/detail/boxed_cells.h>
#include <tetralight/engines/detail/bsp_tree.h>
#include <tetralight/probes/sh.h>

namespace tetralight::detail {

/// What Godot 4 shows at a position relative to the world origin of the volume: barycentric
/// weights in floats, each clamped to [0, 1] and not renormalized
/// (`LightStorage::lightmap_tap_sh_light`).
[[nodiscard]] IrradianceSh tap_godot_light(const BoxedCells& cells, const BspTree& tree,
                                           glm::vec3 position);

}  // namespace tetralight::detail
