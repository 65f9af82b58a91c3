// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/slurm.h>

#include <chrono>
#include <thread>

#include <tetralight/base/process/process.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

using namespace std::chrono_literals;

/// Longer than Slurm waits after SIGTERM before it kills a job (KillWait, 30 s).
constexpr auto kLongestEnd = 120s;

Error unavailable(const std::string& message) {
    return {ErrorCode::Unavailable, "slurm", "", "Slurm: " + message};
}

/// What one of Slurm's programs writes to stdout.
Result<std::string> ask(const char* program, const std::vector<std::string>& arguments) {
    const auto process = run_process({.program = program,
                                      .arguments = arguments,
                                      .group = ProcessGroup::Own,
                                      .time_limit = 60s});
    if (!process) {
        Error error = process.error().in("Slurm");
        error.code = ErrorCode::Unavailable;
        return error;
    }
    if (process->succeeded()) return std::string(process->output_text());
    const std::string line = process->last_error_line();
    return unavailable(str_cat(program, " ", process->failure(), line.empty() ? "" : ": ", line));
}

}  // namespace

std::vector<std::string> srun_arguments(const std::string& name, uint32_t thread_count,
                                        const std::string& program,
                                        const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"--quiet", "--nodes=1", "--ntasks=1", "--job-name=" + name};
    all.push_back(thread_count == 0 ? "--exclusive" : str_cat("--cpus-per-task=", thread_count));
    all.push_back("--");
    all.push_back(program);
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
}

Status end_slurm_jobs(const std::string& name) {
    const auto end = std::chrono::steady_clock::now() + kLongestEnd;
    while (true) {
        const auto jobs = ask("squeue", {"--noheader", "--name=" + name, "--format=%i"});
        if (!jobs) return jobs.error();
        if (jobs->empty()) return Ok{};
        if (std::chrono::steady_clock::now() > end)
            return unavailable(str_cat("a job named ", name, " does not end"));
        if (const auto ended = ask("scancel", {"--name=" + name}); !ended) return ended.error();
        std::this_thread::sleep_for(500ms);
    }
}

Status find_slurm() {
    for (const char* program : {kSrun, "squeue", "scancel"})
        if (const auto version = ask(program, {"--version"}); !version) return version.error();
    return Ok{};
}

}  // namespace tetralight::server
