// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/run_task.h>

namespace tetralight::cli {

/// A result that was joined.
struct CollectedResult {
    std::string output;
    bool was_done = false;  ///< it did not change
    uint64_t bytes = 0;
    double seconds = 0.0;  ///< of its tasks
    Json report;           ///< of the command that joined it; an object
    Json leaks;            ///< of `check-leaks`; null: not asked for
};

/// Joins the tasks of a result in its file in a folder, and measures its leaks if its scene has a
/// limit of them. What was done before and did not change is not done again. The working folder has
/// to be that of the job. Returns unavailable with the numbers of the tasks that are not done, and
/// the errors of the commands.
[[nodiscard]] Result<CollectedResult> collect_result(const PlanFile& plan, const PlanResult& result,
                                                     const std::string& folder,
                                                     const CommonOptions& common);

}  // namespace tetralight::cli
