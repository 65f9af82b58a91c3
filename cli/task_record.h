// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/plan_file.h>

// What a job knows of tasks that are done: a file for each in its folder `done`, called by the key
// of the task, so that another plan finds what did not change.

namespace tetralight::cli {

struct TaskRecord {
    std::string key;     ///< of the task
    uint64_t bytes = 0;  ///< of its file
    double seconds = 0.0;
    std::string host;
    Json report;  ///< of its command
};

/// The record of a task whose file is there; none if it is not done, or was done for another plan.
[[nodiscard]] std::optional<TaskRecord> find_record(const std::string& job, const PlanFile& plan,
                                                    size_t task);

/// What is wrong with the file of a task that has a record, and is not done for that; empty:
/// nothing, or the task has no record.
[[nodiscard]] std::string damage_of(const std::string& job, const PlanFile& plan, size_t task);

/// Writes the record of a task whose file was written. The old file stays whole on failure.
[[nodiscard]] Status write_record(const std::string& job, const PlanFile& plan, size_t task,
                                  double seconds, const Json& report);

/// The tasks among `tasks` that are not done.
[[nodiscard]] std::vector<size_t> tasks_to_do(const std::string& job, const PlanFile& plan,
                                              const std::vector<size_t>& tasks);

/// Removes parts and records that no task of the plan has. What cannot be removed stays.
void remove_other_results(const std::string& job, const PlanFile& plan);

}  // namespace tetralight::cli
