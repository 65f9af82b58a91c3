// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/run_task.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// Numbers that an error names.
constexpr size_t kMostNamed = 10;

fs::path collected_path(const PlanResult& result) {
    return fs::path("done") / str_cat(result.scene, ".", result.kind, ".json");
}

/// What was collected before; an empty object if nothing was, or it was changed since.
Json collected_before(const PlanResult& result, const std::string& output) {
    std::error_code error;
    if (!fs::is_regular_file(collected_path(result), error) || !fs::is_regular_file(output, error))
        return Json::object();
    const auto bytes = read_file(collected_path(result).string());
    if (!bytes) return Json::object();
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const Json json = check_json_object(text) ? Json::parse(text) : Json::object();
    const bool is_same = json.value("key", Json()) == result.key &&
                         json.value("output", Json()) == output &&
                         json.value("bytes", Json()) == fs::file_size(output, error);
    return is_same ? json : Json::object();
}

Status write_json(const fs::path& path, const Json& json) {
    const std::string text = dump(json, 1) + "\n";
    return write_file(path.string(), std::as_bytes(std::span(text)));
}

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
            str_cat(missing.size(), " of ", count, missing.size() == 1 ? " task is" : " tasks are",
                    " not done: ", numbers)};
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

Result<ResultRun> collect_result(const PlanFile& plan, const PlanResult& result,
                                 const std::string& folder, const CommonOptions& common) {
    const auto missing = tasks_to_do(".", plan, result.tasks);
    if (!missing.empty()) {
        return tasks_missing(missing, result.tasks.size())
            .in(str_cat(result.scene, ": ", result.kind));
    }
    const std::string output = (fs::path(folder) / result.file).string();
    double seconds = 0.0;
    for (const size_t task : result.tasks) seconds += find_record(".", plan, task)->seconds;
    Json collected = collected_before(result, output);
    const bool was_done = !collected.empty();
    if (!was_done) {
        Json command = result.command;
        command["output"] = output;
        auto report = run_command(command, common);
        if (!report) return report.error();
        std::error_code ignored;
        collected = {{"key", result.key},
                     {"output", output},
                     {"bytes", fs::file_size(output, ignored)},
                     {"report", std::move(*report)}};
        if (auto status = write_json(collected_path(result), collected); !status)
            return status.error();
    }
    return ResultRun{output, was_done, collected.value("bytes", uint64_t{0}), seconds,
                     collected.value("report", Json::object())};
}

Result<Json> write_job_report(const PlanFile& plan, const std::vector<ResultRun>& results,
                              const std::string& folder) {
    Json scenes = Json::object();
    for (size_t i = 0; i < results.size(); ++i) {
        const ResultRun& run = results[i];
        scenes[plan.results[i].scene][plan.results[i].kind] = {
            {"file", plan.results[i].file},
            {"bytes", run.bytes},
            {"seconds", run.seconds},
            {"rays", run.report.value("rays", Json())},
            {"report", run.report}};
    }
    const fs::path path = fs::path(folder) / "report.json";
    Json report{{"scenes", std::move(scenes)}};
    if (auto status = write_json(path, report); !status) return status.error();
    return report;
}

Status enter_folder(const std::string& folder) {
    std::error_code error;
    fs::current_path(folder, error);
    if (!error) return Ok{};
    return Error{ErrorCode::Unavailable, "job", folder,
                 str_cat(folder, ": cannot be entered: ", error.message())};
}

}  // namespace tetralight::cli
