// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/plan_file.h>
#include <tetralight/cli/task_record.h>

namespace tetralight::cli {

/// Runs a command of a plan in the working folder and returns its report. `threads`: as --threads.
/// An interrupted one keeps its work.
[[nodiscard]] Result<Json> run_command(const Json& command, const CommonOptions& common);

struct TaskRun {
    TaskRecord record;
    bool was_done = false;  ///< by an earlier run
};

/// Runs a task, unless its result is there, and records it. The working folder has to be that of
/// the job. Returns unavailable if a task of an earlier phase is not done, and the errors of the
/// task's command.
[[nodiscard]] Result<TaskRun> run_task(const PlanFile& plan, size_t task,
                                       const CommonOptions& common);

/// "3 of 12 tasks are not done: 4, 7, 9".
[[nodiscard]] Error tasks_missing(const std::vector<size_t>& missing, size_t count);

/// Makes a folder the working folder. Errors name it.
[[nodiscard]] Status enter_folder(const std::string& folder);

}  // namespace tetralight::cli
