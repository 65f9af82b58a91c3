// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/submission.h>

namespace tetralight::cli {

[[nodiscard]] std::vector<JobFile> make_files(const Submission& submission);

/// The command that runs them.
[[nodiscard]] CommandWords make_command(const Submission& submission, const CommonOptions& common);

/// Writes the files and runs make until it ends, with this process's streams; as JSON, what make
/// writes to stdout goes to stderr. SIGTERM is passed on. Returns unsupported if make or a task
/// fails, and cancelled after a signal.
[[nodiscard]] Status submit_to_make(const Submission& submission, const CommonOptions& common);

}  // namespace tetralight::cli
