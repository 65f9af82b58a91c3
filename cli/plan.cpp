// SPDX-License-Identifier: Apache-2.0
#include <numeric>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/make_plan.h>
#include <tetralight/cli/task_record.h>

namespace tetralight::cli {
namespace {

std::vector<size_t> all_tasks(const PlanFile& plan) {
    std::vector<size_t> tasks(plan.tasks.size());
    std::iota(tasks.begin(), tasks.end(), size_t{0});
    return tasks;
}

void report(const CommonOptions& common, const std::string& job, const PlanFile& plan) {
    double cost = 0.0, rays = 0.0;
    for (const PlanTask& task : plan.tasks) {
        cost += task.cost;
        rays += task.rays;
    }
    const size_t done = plan.tasks.size() - tasks_to_do(job, plan, all_tasks(plan)).size();
    Json phases = Json::array();
    for (const PlanPhase& phase : plan.phases) phases.push_back({phase.begin, phase.end});
    Json files = Json::array();
    for (const PlanResult& result : plan.results) files.push_back(result.file);
    std::string text = str_cat(job, ": ", counted(plan.tasks.size(), "task"), " in ",
                               counted(plan.phases.size(), "phase"), ", about ", magnitude(rays),
                               "rays, ", duration(cost), " on this machine");
    if (done > 0) text += str_cat("; ", done, done == 1 ? " is done" : " are done");
    common.print({{"job", job},
                  {"tasks", plan.tasks.size()},
                  {"done", done},
                  {"phases", phases},
                  {"files", files},
                  {"rays", rays},
                  {"seconds", cost}},
                 text);
}

}  // namespace

Status run_plan(const Values& values) {
    PlanSettings settings{.job = values.text("output"),
                          .task_count = values.integer("tasks"),
                          .task_seconds = values.number("task_seconds"),
                          .earlier_folder = {},
                          .common = CommonOptions(values)};
    const auto orders = read_order(values.text("order"));
    if (!orders) return orders.error();
    const auto plan = make_plan(*orders, settings);
    if (!plan) return plan.error();
    report(settings.common, settings.job, *plan);
    return Ok{};
}

}  // namespace tetralight::cli
