// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/submission.h>

#include <filesystem>
#include <numeric>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/task_record.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSubmitFormat = "tetralight-submit";

fs::path settings_path(const std::string& job) {
    return fs::path(job) / "submit.json";
}

/// A word as a shell reads it.
std::string shown_word(const std::string& word) {
    constexpr const char* kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789%+,-./:=@_";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

Result<std::string> output_from(const std::string& text) {
    if (auto status = check_json_object(text); !status) return status.error();
    const Json json = Json::parse(text);
    if (json.value("format", Json()) != kSubmitFormat)
        return Error{ErrorCode::Unsupported, "format", "", "was not written by `submit`"};
    const Json output = json.value("output", Json(""));
    if (output.is_string()) return output.get<std::string>();
    return Error{ErrorCode::Corrupt, "output", output.dump(), "output is not a text"};
}

}  // namespace

std::vector<PhaseWork> phases_to_do(const std::string& job, const PlanFile& plan) {
    std::vector<PhaseWork> phases;
    for (size_t i = 0; i < plan.phases.size(); ++i) {
        const PlanPhase& range = plan.phases[i];
        std::vector<size_t> tasks(range.end - range.begin);
        std::iota(tasks.begin(), tasks.end(), range.begin);
        tasks = tasks_to_do(job, plan, tasks);
        if (!tasks.empty()) phases.push_back({i, range, std::move(tasks)});
    }
    return phases;
}

size_t task_count(const Submission& submission) {
    size_t count = 0;
    for (const PhaseWork& phase : submission.phases) count += phase.tasks.size();
    return count;
}

JobFile settings_file(const Submission& submission) {
    Json json{{"format", kSubmitFormat}, {"version", 1}};
    if (!submission.output.empty()) json["output"] = submission.output;
    return {"submit.json", dump(json, 1) + "\n"};
}

Result<std::string> output_of_job(const std::string& job) {
    const std::string usual = (fs::path(job) / "baked").string();
    std::error_code ignored;
    if (!fs::exists(settings_path(job), ignored)) return usual;
    const auto bytes = read_file(settings_path(job).string());
    if (!bytes) return bytes.error();
    const auto output = output_from({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!output) return output.error().in(settings_path(job).string());
    return output->empty() ? usual : *output;
}

Status write_job_files(const std::string& job, const std::vector<JobFile>& files) {
    const std::string logs = (fs::path(job) / "logs").string();
    if (auto status = make_folder(logs, "job"); !status) return status;
    for (const JobFile& file : files) {
        const fs::path path = fs::path(job) / file.path;
        if (auto status = make_folder(path.parent_path().string(), "job"); !status) return status;
        if (auto status = write_file(path.string(), std::as_bytes(std::span(file.text))); !status)
            return status;
    }
    return Ok{};
}

std::string preview(const std::string& job, const std::vector<JobFile>& files,
                    const std::vector<CommandWords>& commands) {
    std::string text;
    for (const JobFile& file : files)
        text += str_cat("== ", (fs::path(job) / file.path).string(), "\n", file.text, "\n");
    for (size_t i = 0; i < commands.size(); ++i) {
        text += i == 0 ? "$" : "\n$";
        for (const std::string& word : commands[i]) text += " " + shown_word(word);
    }
    return text;
}

}  // namespace tetralight::cli
