// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/collect.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/make_plan.h>
#include <tetralight/cli/progress.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

void announce(const CommonOptions& common, const PlanFile& plan, size_t task) {
    if (common.is_quiet) return;
    std::cerr << printable(str_cat("task ", task + 1, " of ", plan.tasks.size(), ": ",
                                   plan.tasks[task].name))
              << '\n';
}

}  // namespace

/// `plan`, `task` and `collect` on one machine, with one task for each range: nothing is gained by
/// more.
Status run_bake_all(const Values& values) {
    const CommonOptions common(values);
    set_progress_lines(choice<ProgressLines>(values, "progress"));
    const std::string folder = fs::absolute(values.text("output")).lexically_normal().string();
    const PlanSettings settings{.job = (fs::path(folder) / "job").string(),
                                .task_count = 1,
                                .earlier_folder = folder,
                                .common = common};
    const auto orders = read_order(values.text("order"));
    if (!orders) return orders.error();
    const auto plan = make_plan(*orders, settings);
    if (!plan) return plan.error();
    if (auto status = enter_folder(settings.job); !status) return status;
    for (size_t task = 0; task < plan->tasks.size(); ++task) {
        if (!find_record(".", *plan, task)) announce(common, *plan, task);
        const auto run = run_task(*plan, task, common);
        if (!run) return run.error();
    }
    return collect_all(*plan, folder, common);
}

}  // namespace tetralight::cli
