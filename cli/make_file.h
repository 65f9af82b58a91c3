// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/submission.h>

namespace tetralight::cli {

/// `Makefile` of a job: a target for each task that is not done, and `collect`, which joins the
/// results and is made without a target. It has numbers of tasks alone. Its variable TETRALIGHT,
/// of the environment or of make, names the command.
[[nodiscard]] JobFile make_file(const Submission& submission);

}  // namespace tetralight::cli
