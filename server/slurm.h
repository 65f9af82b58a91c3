// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

// Programs on the machines of a Slurm cluster. They see the data folder and the program at the same
// paths as the server. Slurm's own variables (SLURM_PARTITION, SLURM_ACCOUNT...) choose machines.

namespace tetralight::server {

/// The program that waits for a job in the place of the one that the job runs.
inline constexpr const char* kSrun = "srun";

/// Arguments of `srun` that run a program in this working folder, with its stdin and stdout.
/// `name`: of the job. `thread_count`: processors of one machine; 0 = all of them.
[[nodiscard]] std::vector<std::string> srun_arguments(const std::string& name,
                                                      uint32_t thread_count,
                                                      const std::string& program,
                                                      const std::vector<std::string>& arguments);

/// Ends the jobs of this name, and waits until none is left: `srun` may have died before its job.
/// Returns unavailable if Slurm does not answer or a job does not end.
[[nodiscard]] Status end_slurm_jobs(const std::string& name);

/// Returns unavailable if Slurm's programs are not installed.
[[nodiscard]] Status find_slurm();

}  // namespace tetralight::server
