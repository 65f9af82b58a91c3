// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/plan_file.h>
#include <tetralight/cli/plan_order.h>

namespace tetralight::cli {

struct PlanSettings {
    std::string job;  ///< the folder
    /// Tasks of the probes and of the lightmaps of each scene; 0: as `task_seconds` asks.
    size_t task_count = 0;
    /// What a task should take on this machine.
    double task_seconds = 300.0;
    /// Earlier results, whose probes are reused where nothing changed; empty: none.
    std::string earlier_folder;
    CommonOptions common;
};

/// Cuts orders into tasks and writes the job: prepared bakes, then `plan.json`. Where a job is
/// there, what did not change keeps its tasks, so that their results count. Results of tasks that
/// are no longer planned are removed. Returns the errors of preparing each bake, with the place in
/// the order; cancelled after a signal.
[[nodiscard]] Result<PlanFile> make_plan(std::span<const SceneOrder> orders,
                                         const PlanSettings& settings);

}  // namespace tetralight::cli
