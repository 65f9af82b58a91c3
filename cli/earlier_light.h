// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/plan_file.h>
#include <tetralight/pipeline/lamp_strengths.h>

// Lamps of layers of their own that became stronger or weaker: earlier light gets other weights,
// and nothing is baked.

namespace tetralight::cli {

/// What a later plan compares with, as JSON: {"key", "strengths"}. `content`: all that the result
/// depends on beside the scene, without the intensities of lights.
[[nodiscard]] Json lamps_json(const LampStrengths& lamps, const std::string& content);

/// If the folder has this result of a scene that differs in strengths alone, makes `relight` its
/// command, keeps the earlier file in `earlier/` of the job, and returns true. The result has no
/// tasks then, and the strengths as they were baked.
[[nodiscard]] Result<bool> take_earlier_light(const std::string& job, const std::string& folder,
                                              PlanResult& result);

}  // namespace tetralight::cli
