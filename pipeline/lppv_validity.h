// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv_grid.h>

namespace tetralight {

/// What `LppvFill::validity` takes, for the scene's static geometry: 0 for grid points inside of
/// it, as `ProbeVisibility::is_inside` judges, else the share of directions without back faces.
/// Error: not enough memory.
[[nodiscard]] Result<std::vector<float>> survey_grid(const Scene& scene, const LppvGrid& grid,
                                                     uint32_t thread_count);

}  // namespace tetralight
