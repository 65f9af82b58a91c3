// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/json_file.h>
#include <tetralight/cli/submit_slurm.h>

#include <algorithm>
#include <filesystem>

#include <tetralight/base/process/process.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/slurm_script.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSubmittedFormat = "tetralight-submitted";

fs::path submitted_path(const std::string& job) {
    return fs::path(job) / "submitted.json";
}

Result<ProcessResult> run_words(const CommandWords& words, const std::string& folder) {
    return run_process({.program = words.front(),
                        .arguments = {words.begin() + 1, words.end()},
                        .folder = folder});
}

/// "a, b"
std::string joined_by(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// The lines of a text in one.
std::string in_one_line(const std::string& text) {
    std::vector<std::string> lines;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        if (end > begin) lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return joined_by(lines, "; ");
}

/// "12", of "12;cluster".
Result<std::string> number_of_job(std::string_view output) {
    const size_t end = std::min(output.find_first_not_of("0123456789"), output.size());
    if (end > 0) return std::string(output.substr(0, end));
    return Error{ErrorCode::Unsupported, "to", "slurm", "sbatch wrote no number of a job"};
}

/// Sends a job; returns its number.
Result<std::string> send(const CommandWords& words, const std::string& folder) {
    const auto result = run_words(words, folder);
    if (!result && result.error().code == ErrorCode::NotFound) {
        return Error{ErrorCode::NotFound, "to", "slurm",
                     "PATH has no sbatch: Slurm's commands are not installed on this machine"};
    }
    if (!result) return result.error();
    if (result->succeeded()) return number_of_job(result->output_text());
    const std::string why = in_one_line(result->errors);
    return Error{ErrorCode::InvalidArgument, "to", "slurm",
                 why.empty() ? "sbatch " + result->failure() : why};
}

/// Numbers of the jobs that `submitted.json` names.
std::vector<std::string> earlier_jobs(const std::string& job) {
    const Json list = read_object(submitted_path(job)).value("jobs", Json::array());
    std::vector<std::string> jobs;
    for (const Json& one : list) {
        const Json number = one.is_object() ? one.value("job", Json()) : Json();
        if (number.is_number_unsigned()) jobs.push_back(number.dump());
    }
    return jobs;
}

Status write_submitted(const Submission& submission, const Json& jobs) {
    return write_json(
        submitted_path(submission.job),
        {{"format", kSubmittedFormat}, {"version", 1}, {"to", "slurm"}, {"jobs", jobs}});
}

/// Cancels what was sent; returns the error, which says so.
Error taken_back(const Error& error, const std::vector<std::string>& jobs,
                 const std::string& folder) {
    if (jobs.empty()) return error;
    CommandWords words{"scancel"};
    words.insert(words.end(), jobs.begin(), jobs.end());
    const auto result = run_words(words, folder);
    Error all = error;
    all.message = error.message.suffixed(
        str_cat(result && result->succeeded() ? " (cancelled the jobs before it: "
                                              : " (these jobs before it could not be cancelled: ",
                joined_by(jobs, ", "), ")"));
    return all;
}

/// What is sent, in order.
struct Step {
    std::string name;                  ///< "phase 0"
    const PhaseWork* phase = nullptr;  ///< null: collect
};

std::vector<Step> steps_of(const Submission& submission) {
    std::vector<Step> steps;
    for (const PhaseWork& phase : submission.phases)
        steps.push_back({str_cat("phase ", phase.phase), &phase});
    steps.push_back({"collect", nullptr});
    return steps;
}

CommandWords step_words(const Submission& submission, const Step& step, const std::string& after) {
    return step.phase == nullptr ? send_collect(submission, after)
                                 : send_phase(submission, *step.phase, after);
}

Json step_json(const Step& step, const std::string& number) {
    Json json{{"name", step.name}, {"job", Json::parse(number)}};
    if (step.phase != nullptr) json["tasks"] = step.phase->tasks.size();
    return json;
}

}  // namespace

std::vector<JobFile> slurm_files(const Submission& submission) {
    std::vector<JobFile> files = slurm_scripts();
    files.push_back(settings_file(submission));
    return files;
}

std::vector<CommandWords> slurm_commands(const Submission& submission) {
    std::vector<CommandWords> commands;
    std::string after;
    for (const Step& step : steps_of(submission)) {
        commands.push_back(step_words(submission, step, after));
        if (step.phase != nullptr) after = str_cat("PHASE_", step.phase->phase);
    }
    return commands;
}

Result<Json> submit_to_slurm(const Submission& submission) {
    if (submission.job.find('\\') != std::string::npos) {
        return Error{ErrorCode::InvalidArgument, "job", submission.job,
                     str_cat(submission.job, ": Slurm cannot write logs to a path with \\")};
    }
    if (auto status = check_slurm_is_done(submission.job); !status) return status.error();
    if (auto status = write_job_files(submission.job, slurm_files(submission)); !status)
        return status.error();
    std::vector<std::string> sent;
    Json jobs = Json::array();
    for (const Step& step : steps_of(submission)) {
        const CommandWords words = step_words(submission, step, sent.empty() ? "" : sent.back());
        const auto number = send(words, submission.job);
        if (!number) return taken_back(number.error().in(step.name), sent, submission.job);
        sent.push_back(*number);
        jobs.push_back(step_json(step, *number));
    }
    if (auto status = write_submitted(submission, jobs); !status)
        return taken_back(status.error(), sent, submission.job);
    return jobs;
}

Status check_slurm_is_done(const std::string& job) {
    const std::vector<std::string> jobs = earlier_jobs(job);
    if (jobs.empty()) return Ok{};
    const auto queue =
        run_words({"squeue", "--noheader", "--format=%A", "--jobs=" + joined_by(jobs, ",")}, job);
    // It fails once Slurm has forgotten all of them.
    if (!queue || !queue->succeeded() || queue->output.empty()) return Ok{};
    return Error{ErrorCode::InvalidArgument, "job", job,
                 str_cat(job, ": was sent, and Slurm still works for it: wait, or end it by ",
                         "`scancel ", joined_by(jobs, " "), "`")};
}

}  // namespace tetralight::cli
