// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/plan_file.h>

// What is sent to a scheduler (docs/schedulers.md). No text of users becomes text of a script:
//
//     plan.json ─→ Submission ─┬→ slurm/*.sbatch, sbatch ─→ submitted.json
//                              └→ Makefile, make

namespace tetralight::cli {

/// The tasks of a phase that are not done.
struct PhaseWork {
    size_t phase = 0;
    PlanPhase range;            ///< all tasks of the phase
    std::vector<size_t> tasks;  ///< not empty, ascending
};

struct Submission {
    std::string job;       ///< absolute path of its folder
    std::string output;    ///< absolute path of a folder; empty: "baked" in the job
    std::string program;   ///< the command, where the machines that run tasks have it
    uint32_t at_once = 0;  ///< tasks; 0: no limit
    uint32_t thread_count = 0;
    uint32_t restart_count = 0;
    std::vector<std::string> options;  ///< of sbatch or make
    std::vector<PhaseWork> phases;
};

/// A file of a job: its path in the folder of the job, and its text.
struct JobFile {
    std::string path;
    std::string text;
};

/// A program and its arguments.
using CommandWords = std::vector<std::string>;

/// The phases of a plan that have tasks to do, with those.
[[nodiscard]] std::vector<PhaseWork> phases_to_do(const std::string& job, const PlanFile& plan);

[[nodiscard]] size_t task_count(const Submission& submission);

/// `submit.json`: what `collect` reads of a submission.
[[nodiscard]] JobFile settings_file(const Submission& submission);

/// The folder that `submit.json` of a job names; "baked" in the job without one. Errors name the
/// file.
[[nodiscard]] Result<std::string> output_of_job(const std::string& job);

/// Writes files of a job; makes their folders, and "logs".
[[nodiscard]] Status write_job_files(const std::string& job, const std::vector<JobFile>& files);

/// Files and commands for people to read: "== job/Makefile", its lines, "$ make -j4".
[[nodiscard]] std::string preview(const std::string& job, const std::vector<JobFile>& files,
                                  const std::vector<CommandWords>& commands);

}  // namespace tetralight::cli
