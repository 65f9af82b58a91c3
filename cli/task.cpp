// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/run_task.h>

namespace tetralight::cli {

Status run_task(const Values& values) {
    const std::string job = values.text("job");
    const CommonOptions common(values);
    set_progress_lines(choice<ProgressLines>(values, "progress"));
    const auto plan = read_plan(job);
    if (!plan) return plan.error();
    const uint64_t task = values.integer("task");
    if (task >= plan->tasks.size()) {
        return Error{ErrorCode::InvalidArgument, "task", str_cat(task),
                     str_cat(values.shown("task"), ": there is no task ", task, "; ", job, " has ",
                             counted(plan->tasks.size(), "task"), ", from 0")};
    }
    if (auto status = enter_folder(job); !status) return status;
    const auto run = run_task(*plan, task, common);
    if (!run) return run.error();
    const PlanTask& done = plan->tasks[task];
    common.print({{"task", task},
                  {"name", done.name},
                  {"output", done.output()},
                  {"was_done", run->was_done},
                  {"seconds", run->record.seconds},
                  {"bytes", run->record.bytes},
                  {"report", run->record.report}},
                 str_cat("task ", task, ", ", done.name,
                         run->was_done ? ": was done before"
                                       : str_cat(": done in ", duration(run->record.seconds))));
    return Ok{};
}

}  // namespace tetralight::cli
