// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/cli/submission.h>

namespace tetralight::cli {

/// A larger array is refused by Slurm, unless its administrator allows more (MaxArraySize, 1001).
inline constexpr size_t kMostArrayElements = 1000;

/// `slurm/task.sbatch` and `slurm/collect.sbatch`: the same in every job.
[[nodiscard]] std::vector<JobFile> slurm_scripts();

/// How many tasks of a phase one element of its array runs, one after the other.
[[nodiscard]] size_t tasks_per_element(const PhaseWork& phase);

/// The elements of the array of a phase that have tasks to do: "0-11,14".
[[nodiscard]] std::string array_elements(const PhaseWork& phase);

/// The sbatch that sends a phase. `after`: the job that has to succeed before; empty: none.
[[nodiscard]] CommandWords send_phase(const Submission& submission, const PhaseWork& phase,
                                      const std::string& after);

/// The sbatch that sends the joining of all results.
[[nodiscard]] CommandWords send_collect(const Submission& submission, const std::string& after);

}  // namespace tetralight::cli
