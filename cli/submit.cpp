// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/submission.h>
#include <tetralight/cli/submit_make.h>
#include <tetralight/cli/submit_slurm.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// In the order of the choices of `to`.
enum class Scheduler : uint8_t { Slurm, Make };

std::string absolute_path(const std::string& path) {
    fs::path whole = fs::absolute(path).lexically_normal();
    if (!whole.has_filename()) whole = whole.parent_path();
    return whole.string();
}

/// This command's own file, if no other is named. A name without a slash is one that PATH finds.
std::string program_of(const Values& values) {
    const std::string given = values.text("program");
    if (!given.empty()) return given.find('/') == std::string::npos ? given : absolute_path(given);
    std::error_code ignored;
    const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
    return self.empty() ? "tetralight" : self.string();
}

Result<Submission> submission_of(const Values& values) {
    const std::string job = values.text("job"), output = values.text("output");
    const auto plan = read_plan(job);
    if (!plan) return plan.error();
    if (!is_utf8(output)) {
        return Error{ErrorCode::InvalidArgument, "output", output,
                     values.shown("output") + ": is not UTF-8"};
    }
    return Submission{.job = absolute_path(job),
                      .output = output.empty() ? "" : absolute_path(output),
                      .program = program_of(values),
                      .at_once = values.integer32("at_once"),
                      .thread_count = values.integer32("threads"),
                      .restart_count = values.integer32("restarts"),
                      .options = values.texts("option"),
                      .phases = phases_to_do(job, *plan)};
}

Json submission_json(const Submission& submission, const char* scheduler) {
    return {{"job", submission.job}, {"to", scheduler}, {"tasks", task_count(submission)}};
}

void print_preview(const CommonOptions& common, const Submission& submission,
                   const std::vector<JobFile>& files, const std::vector<CommandWords>& commands) {
    Json json = submission_json(submission, commands.front().front() == "make" ? "make" : "slurm");
    json["files"] = Json::object();
    for (const JobFile& file : files) json["files"][file.path] = file.text;
    json["commands"] = commands;
    common.print(json, preview(submission.job, files, commands));
}

Status send_to_slurm(const Submission& submission, const CommonOptions& common) {
    auto jobs = submit_to_slurm(submission);
    if (!jobs) return jobs.error();
    Json json = submission_json(submission, "slurm");
    std::string text = str_cat(submission.job, ": sent ", counted(task_count(submission), "task"));
    for (const Json& job : *jobs)
        text += str_cat("; ", job["name"].get<std::string>(), ": job ", job["job"].dump());
    json["jobs"] = std::move(*jobs);
    common.print(json, text);
    return Ok{};
}

Status run_by_make(const Submission& submission, const CommonOptions& common) {
    if (auto status = submit_to_make(submission, common); !status) return status;
    // The task that collects has said the rest.
    if (common.is_json) common.print(submission_json(submission, "make"), "");
    return Ok{};
}

}  // namespace

Status run_submit(const Values& values) {
    const CommonOptions common(values);
    const bool is_slurm = choice<Scheduler>(values, "to") == Scheduler::Slurm;
    const auto submission = submission_of(values);
    if (!submission) return submission.error();
    if (values.flag("dry_run")) {
        if (is_slurm) {
            print_preview(common, *submission, slurm_files(*submission),
                          slurm_commands(*submission));
        } else {
            print_preview(common, *submission, make_files(*submission),
                          {make_command(*submission, common)});
        }
        return Ok{};
    }
    return is_slurm ? send_to_slurm(*submission, common) : run_by_make(*submission, common);
}

}  // namespace tetralight::cli
