// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/lighting_plan.h>

namespace tetralight::cli {

/// Declares `--mixed-lighting` and `--layers`.
void add_lighting_options(CLI::App& command, LightingSettings& settings);

/// Prints what a bake takes of each light of a scene and what is left to the runtime. Errors: those
/// of `plan_lighting`.
[[nodiscard]] Status explain(const Scene& scene, const LightingSettings& settings,
                             const CommonOptions& common);

}  // namespace tetralight::cli
