// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/error.h>
#include <tetralight/cli/values.h>

// How the command ends when it fails: what it prints and its exit code (docs/command.md).

namespace tetralight::cli {

inline constexpr int kExitFine = 0;
inline constexpr int kExitBadData = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitTryAgain = 75;  ///< EX_TEMPFAIL of sysexits.h
inline constexpr int kExitSignal = 128;   ///< plus the number of the signal, as shells have it

using settings::Json;

/// Where and how a failure is shown.
struct FailureStyle {
    bool is_json = false;
    /// The output itself goes to stdout, so that JSON goes to stderr.
    bool is_stdout_taken = false;
    /// "bake", or empty.
    std::string_view command = {};
};

/// {"code": "corrupt", "field": "...", "value": "...", "message": "..."}
[[nodiscard]] Json error_json(const Error& error);

/// Prints an error of wrong usage. Returns the exit code.
int print_usage_error(const Error& error, const FailureStyle& style);

/// Prints any other error. Returns the exit code.
int print_failure(const Error& error, const FailureStyle& style);

/// The same error, for a command that has results to report nevertheless: as JSON its object has
/// the members of `report` before "error".
[[nodiscard]] Error with_report(Error error, Json report);

/// Call when an interrupted bake keeps its work, so that SIGTERM means "try again".
void note_checkpoint();

/// From now on warnings are a member of the JSON result instead of lines on stderr.
void begin_job();

/// Warnings so far of a job; null if this is no job.
[[nodiscard]] std::vector<std::string>* warnings_of_job();

/// In a job that has warnings, with a member "warnings".
[[nodiscard]] Json with_warnings(Json result);

}  // namespace tetralight::cli
