// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bake/scene/scene.h"
#include "base/result.h"
#include "lppv/lppv_grid.h"

namespace tetralight {

/// What `LppvFill::validity` takes, for the scene's static geometry: 0 for grid points inside of
/// it, as `Surroundings::is_inside` judges, else the share of directions without back faces.
/// Error: not enough memory.
[[nodiscard]] Result<std::vector<float>> survey_grid(const Scene& scene, const LppvGrid& grid,
                                                     uint32_t thread_count);

}  // namespace tetralight
