// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>

// A job: a folder with a bake that was cut into tasks (docs/farm.md).
//
//     plan ─→ plan.json, prepared/ ─→ task 0, task 1, ... ─→ parts/, done/ ─→ collect ─→ baked/

namespace tetralight::cli {

/// A command that a machine runs in the folder of the job. It may run twice, or on two machines at
/// once: it writes the same file.
struct PlanTask {
    std::string name;  ///< for people: "hall: probes 0..1200"
    /// Seconds that it is expected to take on the machine that planned it.
    double cost = 0.0;
    /// Rays that it is expected to trace.
    double rays = 0.0;
    /// Hash of all that its result depends on.
    std::string key;
    Json command;  ///< as `--job` takes it

    /// The file that it writes, in the folder of the job.
    [[nodiscard]] std::string output() const;
};

/// Tasks [begin, end): they may run at once, after all tasks of earlier phases.
struct PlanPhase {
    size_t begin = 0;
    size_t end = 0;
};

/// A command that joins the results of tasks in one file that users want.
struct PlanResult {
    std::string scene;  ///< its name in the order
    std::string kind;   ///< "probes", "lightmaps" or "reflections"
    std::string file;   ///< "hall.probes"
    std::string key;
    /// Bytes that the file is expected to have; 0 = not known.
    size_t bytes = 0;
    std::vector<size_t> tasks;
    Json command;  ///< without its output
    /// What a later plan compares its lamps with (cli/earlier_light.h); an empty object: nothing.
    Json lamps = Json::object();

    /// The file in the folder `done` of the job that says that it was joined.
    [[nodiscard]] std::string record_name() const;
};

/// A scene of the order.
struct PlanScene {
    std::string name;
    Json limits;  ///< of its results; an object of numbers
    /// The command that measures light through walls in its probes, without their file; an empty
    /// object: it is not asked for.
    Json leak_check;
};

struct PlanFile {
    std::vector<PlanScene> scenes;
    std::vector<PlanPhase> phases;
    std::vector<PlanTask> tasks;
    std::vector<PlanResult> results;
};

/// Reads `plan.json` of a job. Returns not_found if the folder holds no plan, unsupported for that
/// of another version, and corrupt with the member for one that is not well-formed. Errors name the
/// file.
[[nodiscard]] Result<PlanFile> read_plan(const std::string& job);

/// Writes `plan.json`; the old file stays whole on failure.
[[nodiscard]] Status write_plan(const std::string& job, const PlanFile& plan);

/// "0017": the number of a task in names of files.
[[nodiscard]] std::string task_digits(size_t task);

}  // namespace tetralight::cli
