// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/submit_make.h>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/interrupt.h>
#include <tetralight/cli/make_file.h>

namespace tetralight::cli {
namespace {

uint32_t tasks_at_once(const Submission& submission) {
    return std::max(1u, submission.at_once);
}

/// Of each task: an equal share of the processors, unless the user says how many.
uint32_t threads_of_task(const Submission& submission) {
    if (submission.thread_count > 0) return submission.thread_count;
    return std::max(1u, std::thread::hardware_concurrency() / tasks_at_once(submission));
}

Result<pid_t> start_make(const CommandWords& words, const CommonOptions& common) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    if (common.is_json) ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    pid_t process = -1;
    errno = ::posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
    const int failure = errno;
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure == 0) return process;
    errno = failure;
    if (failure != ENOENT) return system_error("start make");
    return Error{ErrorCode::NotFound, "to", "make",
                 "PATH has no make: GNU make is not installed on this machine"};
}

/// Waits for the end of a process, and passes SIGTERM on to it. A terminal sends Ctrl-C to both.
int wait_for(pid_t process) {
    bool is_passed_on = false;
    int status = 0;
    while (true) {
        const pid_t ended = ::waitpid(process, &status, WNOHANG);
        if (ended == process || (ended < 0 && errno != EINTR)) return status;
        if (Interrupt::signal() == SIGTERM && !is_passed_on) {
            ::kill(process, SIGTERM);
            is_passed_on = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

Error failure_of(const Submission& submission, int status) {
    if (Interrupt::signal() != 0) {
        note_checkpoint();  // tasks save their work
        return {ErrorCode::Cancelled, "interrupted"};
    }
    const std::string end = WIFEXITED(status)
                                ? str_cat("make ended with exit code ", WEXITSTATUS(status))
                                : str_cat("make ended by signal ", WTERMSIG(status));
    return {ErrorCode::Unsupported, "to", "make",
            str_cat(submission.job, ": ", end, "; the same command continues")};
}

}  // namespace

std::vector<JobFile> make_files(const Submission& submission) {
    return {make_file(submission), settings_file(submission)};
}

CommandWords make_command(const Submission& submission, const CommonOptions& common) {
    CommandWords words{"make",
                       "--keep-going",
                       "--no-print-directory",
                       "-C",
                       submission.job,
                       str_cat("--jobs=", tasks_at_once(submission)),
                       str_cat("THREADS=", threads_of_task(submission))};
    if (common.is_quiet) words.emplace_back("OPTIONS=--quiet");
    words.insert(words.end(), submission.options.begin(), submission.options.end());
    return words;
}

Status submit_to_make(const Submission& submission, const CommonOptions& common) {
    if (auto status = write_job_files(submission.job, make_files(submission)); !status)
        return status.error();
    ::setenv("TETRALIGHT", submission.program.c_str(), 1);
    const Interrupt interrupt;
    const auto process = start_make(make_command(submission, common), common);
    if (!process) return process.error();
    const int status = wait_for(*process);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return Ok{};
    return failure_of(submission, status);
}

}  // namespace tetralight::cli
