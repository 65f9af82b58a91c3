// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <tetralight/base/error.h>
#include <tetralight/server/json.h>
#include <tetralight/server/settings.h>

// Everything that takes long or reads uploaded files runs in a child process, `tetralight --job -`:
// a crash there ends one request or one bake, never the server. The job is one JSON object on the
// child's stdin, and its result is one on stdout.

namespace tetralight::server {

/// The folder of a job's results, in its working folder. Nothing else can be written by a job where
/// the kernel has Landlock (base/process/landlock.h): not its inputs, which are links to stored
/// files.
inline constexpr const char* kResults = "results";

struct Job {
    /// "bake", "render"...
    std::string command;
    /// Its settings by their names. Paths are names of files in `folder`; those of results begin
    /// with `kResults`.
    Json settings;
    /// The working folder.
    std::string folder = {};
    /// The child is killed after this time; 0 = never.
    double limit_seconds = 0.0;
    /// No client waits for it: it runs in a session of its own with the least weight.
    bool is_background = false;
    /// Runs as a Slurm job of this name; empty: on this machine. Slurm's limits are those of the
    /// program then.
    std::string slurm_name = {};
    /// Called a few times a second on the calling thread; true kills the child.
    std::function<bool()> is_cancelled = {};
};

struct JobResult {
    enum class End : uint8_t {
        Done,
        Failed,     ///< `error` says why
        Cancelled,  ///< `is_cancelled` returned true
        TooSlow,
        Crashed,  ///< it ended by a signal or did not start: `error` says how
    };

    End end = End::Crashed;
    /// What the command reports, without the files of its folder; with "warnings" if there are any.
    Json report = Json::object();
    Error error = {};
    /// True if `error` is about the settings, not about the files.
    bool is_wrong_usage = false;
};

/// Runs a job at a lower priority than queries and waits for its end. The child dies with the
/// calling thread.
[[nodiscard]] JobResult run_job(const Settings& settings, const Job& job);

/// The program to run: that of the settings, else this one.
[[nodiscard]] std::string program_of(const Settings& settings);

}  // namespace tetralight::server
