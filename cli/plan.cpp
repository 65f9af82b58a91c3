// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <optional>
#include <thread>
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

/// Of this machine, which costs of tasks are about.
double thread_count(const CommonOptions& common) {
    if (common.thread_count > 0) return common.thread_count;
    return std::max(1u, std::thread::hardware_concurrency());
}

/// With three digits.
std::string rounded(double number) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", number);
    return buffer;
}

std::string size_text(size_t bytes) {
    return magnitude(static_cast<double>(bytes)) + "B";
}

/// `price`: of a processor for an hour; none: not given.
void report(const CommonOptions& common, const std::string& job, const PlanFile& plan,
            std::optional<double> price) {
    double cost = 0.0, rays = 0.0;
    for (const PlanTask& task : plan.tasks) {
        cost += task.cost;
        rays += task.rays;
    }
    const size_t done = plan.tasks.size() - tasks_to_do(job, plan, all_tasks(plan)).size();
    Json phases = Json::array();
    for (const PlanPhase& phase : plan.phases) phases.push_back({phase.begin, phase.end});
    Json files = Json::array();
    size_t bytes = 0;
    for (const PlanResult& result : plan.results) {
        files.push_back({{"file", result.file}, {"bytes", result.bytes}});
        bytes += result.bytes;
    }
    const double core_hours = cost * thread_count(common) / 3600.0;
    std::string text =
        str_cat(job, ": ", counted(plan.tasks.size(), "task"), " in ",
                counted(plan.phases.size(), "phase"), ", about ", magnitude(rays), "rays, ",
                duration(cost), " on this machine; files of ", size_text(bytes));
    if (price)
        text += str_cat("; ", rounded(core_hours * *price), " for ", rounded(core_hours),
                        " core hours");
    if (done > 0) text += str_cat("; ", done, done == 1 ? " is done" : " are done");
    common.print({{"job", job},
                  {"tasks", plan.tasks.size()},
                  {"done", done},
                  {"phases", phases},
                  {"files", files},
                  {"rays", rays},
                  {"seconds", cost},
                  {"core_hours", core_hours},
                  {"price", price ? Json(core_hours * *price) : Json()}},
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
    const bool has_price = values.is_given("core_hour_price");
    report(settings.common, settings.job, *plan,
           has_price ? std::optional(values.number("core_hour_price")) : std::nullopt);
    return Ok{};
}

}  // namespace tetralight::cli
