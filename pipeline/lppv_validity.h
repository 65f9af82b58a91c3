// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv_grid.h>

namespace tetralight {

/// Values of `LppvFill::validity`, one for each grid point: 0 inside the scene's static geometry
/// (`ProbeVisibility::is_inside`), else the fraction of rays that hit no back face. `traced` is the
/// static geometry (`TraceScene::make_static`).
[[nodiscard]] std::vector<float> lppv_grid_validity(const TraceScene& traced, const LppvGrid& grid,
                                                    uint32_t thread_count);

/// The same of a scene. Returns the errors of `TraceScene::make_static`.
[[nodiscard]] Result<std::vector<float>> lppv_grid_validity(const Scene& scene,
                                                            const LppvGrid& grid,
                                                            uint32_t thread_count);

}  // namespace tetralight
