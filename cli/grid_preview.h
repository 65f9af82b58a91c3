// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bake/placement/probe_grid.h"
#include "bake/scene/scene.h"
#include "base/result.h"

namespace tetralight::cli {

/// Bakes a grid quickly and writes a picture of the scene with its probes as balls, lit by what
/// they hold: from the scene's first camera, or from above.
[[nodiscard]] Status write_preview(const std::string& path, const Scene& scene,
                                   const ProbeGrid& grid, uint32_t thread_count);

}  // namespace tetralight::cli
