// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/submission.h>

namespace tetralight::cli {

/// The files that sending to Slurm writes.
[[nodiscard]] std::vector<JobFile> slurm_files(const Submission& submission);

/// The commands that send it, with "PHASE_0" in place of the number of the job of phase 0.
[[nodiscard]] std::vector<CommandWords> slurm_commands(const Submission& submission);

/// Writes the files, and sends an array of jobs for each phase and a job that collects, each after
/// the one before it. `submitted.json` of the job names them. Returns the numbers of the jobs, as
/// that file has them. Where a job is refused, those before it are cancelled. Returns
/// invalid_argument while Slurm has jobs of an earlier submission.
[[nodiscard]] Result<Json> submit_to_slurm(const Submission& submission);

/// Returns invalid_argument while Slurm has jobs of an earlier submission: they run the tasks of
/// the plan by their numbers.
[[nodiscard]] Status check_slurm_is_done(const std::string& job);

}  // namespace tetralight::cli
