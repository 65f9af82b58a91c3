// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A program to run as a child process.
struct ChildCommand {
    /// A path; a name without a slash is looked up in PATH.
    std::string program;
    /// After this time it is killed.
    std::chrono::milliseconds time_limit{0};
    /// Is shown all of stdout so far whenever it has grown; an error ends the child.
    std::function<Status(std::span<const std::byte>)> check_output;

    /// What its errors begin with: the program without its folder.
    [[nodiscard]] std::string name() const;
};

/// Runs a program to its end with `input` on its stdin, and returns what it wrote on stdout.
///
/// Errors, all of one line: the program cannot be started, was ended by a signal, had an exit code
/// other than 0 (with the last line of its stderr), ran too long, or `check_output` refused. None
/// of them leaves a process behind. Whatever the program does or does not read, no signal comes
/// back and nothing waits for it longer than `time_limit`. Thread-safe.
[[nodiscard]] Result<std::vector<std::byte>> run_child(
    const ChildCommand& command, std::span<const std::span<const std::byte>> input);

}  // namespace tetralight::detail
