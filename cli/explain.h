// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/lighting_plan.h>

namespace tetralight::cli {

/// Prints what was read of a scene, what a bake takes from each of its lights, and what the runtime
/// adds. Returns the errors of `plan_lighting`.
[[nodiscard]] Status explain(const Scene& scene, const LightingSettings& settings,
                             const CommonOptions& common);

}  // namespace tetralight::cli
