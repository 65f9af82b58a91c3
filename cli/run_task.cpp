// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/run_task.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// Numbers that an error names.
constexpr size_t kMostNamed = 10;

/// The tasks before the phase of this one.
std::vector<size_t> earlier_tasks(const PlanFile& plan, size_t task) {
    const auto phase =
        std::ranges::find_if(plan.phases, [task](const PlanPhase& one) { return task < one.end; });
    std::vector<size_t> tasks(phase->begin);
    std::iota(tasks.begin(), tasks.end(), size_t{0});
    return tasks;
}

}  // namespace

Result<Json> run_command(const Json& json, const CommonOptions& common) {
    const auto name = json.find("command");
    const bool has_name = name != json.end() && name->is_string();
    const Command* command = has_name ? find_command(name->get<std::string>()) : nullptr;
    if (command == nullptr)
        return Error{ErrorCode::Corrupt, "command", "", "plan.json: a task has no command"};
    const settings::Table& table = *command->table;
    auto values = settings::values_from_json(table, json, settings::Access::Command, "command");
    if (!values) return values.error().in("plan.json");
    values->set(*table.find("quiet"), common.is_quiet);
    values->set(*table.find("threads"), common.thread_count);
    ReportCapture capture;
    try {
        const Status status = command->run(*values);
        if (!status) return status.error();
    } catch (const UsageError& usage) {
        return usage.error.in("plan.json");
    }
    return std::move(capture.report);
}

Error tasks_missing(const std::vector<size_t>& missing, size_t count) {
    std::string numbers;
    for (size_t i = 0; i < std::min(missing.size(), kMostNamed); ++i)
        numbers += str_cat(i == 0 ? "" : ", ", missing[i]);
    if (missing.size() > kMostNamed) numbers += ", ...";
    return {ErrorCode::Unavailable, "tasks", numbers,
            str_cat(missing.size(), " of ", counted(count, "task"),
                    missing.size() == 1 ? " is" : " are", " not done: ", numbers)};
}

Result<TaskRun> run_task(const PlanFile& plan, size_t task, const CommonOptions& common) {
    const std::vector<size_t> before = earlier_tasks(plan, task);
    const std::vector<size_t> missing = tasks_to_do(".", plan, before);
    if (!missing.empty()) {
        return tasks_missing(missing, before.size())
            .in(str_cat("task ", task, " needs those before its phase"));
    }
    if (auto record = find_record(".", plan, task)) return TaskRun{std::move(*record), true};
    const Stopwatch watch;
    const auto report = run_command(plan.tasks[task].command, common);
    if (!report) return report.error();
    const double seconds = watch.seconds();
    if (auto status = write_record(".", plan, task, seconds, *report); !status)
        return status.error();
    auto record = find_record(".", plan, task);
    if (record) return TaskRun{std::move(*record), false};
    return Error{ErrorCode::Unavailable, "output", plan.tasks[task].output(),
                 str_cat(plan.tasks[task].output(), ": was written, and is not there")};
}

Status enter_folder(const std::string& folder) {
    std::error_code error;
    fs::current_path(folder, error);
    if (!error) return Ok{};
    return Error{ErrorCode::Unavailable, "job", folder,
                 str_cat(folder, ": cannot be entered: ", error.message())};
}

}  // namespace tetralight::cli
