// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/run_task.h>

namespace tetralight::cli {

/// Joins all results of a plan in a folder, writes `report.json` and `report.xml` (JUnit) there,
/// and prints what was written. The working folder has to be that of the job. What did not change
/// stays as it is. Returns invalid_argument with the limits that are not kept, and the first error
/// of a result that cannot be joined, after all others were written.
[[nodiscard]] Status collect_all(const PlanFile& plan, const std::string& folder,
                                 const CommonOptions& common);

}  // namespace tetralight::cli
