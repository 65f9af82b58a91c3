// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/process/landlock.h>
#include <tetralight/base/result.h>

// Runs another program and waits for it:
//
//     const auto result = run_process({.program = "tetgen", .arguments = {"-h"}});
//     if (!result) return result.error();  // it did not start
//     if (!result->succeeded()) return Error{ErrorCode::Unsupported, result->failure()};

namespace tetralight {

/// Which signals reach a child process together with this one, and what ends with it.
enum class ProcessGroup : uint8_t {
    /// The group of this process: Ctrl-C at a terminal ends both.
    Shared,
    /// A group of its own: Ctrl-C does not reach it, and ending it ends the programs it started.
    Own,
    /// A session of its own, for work in the background. Linux divides processor time between
    /// sessions before it divides it between their processes (sched(7), autogroup), so that the
    /// niceness of a session counts against all other programs.
    Session,
};

/// A program to run, what it is given, and what it may use.
struct ProcessCommand {
    /// A path; a name without a slash is looked up in PATH.
    std::string program;
    /// Without the name of the program.
    std::vector<std::string> arguments = {};
    /// The file to execute if it is not `program`: "/proc/self/exe". `program` is argument 0 then.
    std::string executable = {};
    /// Its working folder; that of this process if empty.
    std::string folder = {};
    /// What it reads from stdin, one part after the other. The program may read any of it.
    std::span<const std::span<const std::byte>> input = {};

    ProcessGroup group = ProcessGroup::Shared;
    /// Its niceness, 1..19; 0 = that of this process.
    int niceness = 0;
    /// Bytes of data that it may allocate; 0 = no limit.
    uint64_t memory_limit = 0;
    /// Bytes of its whole address space, with the files that it maps; 0 = no limit.
    uint64_t address_space_limit = 0;
    /// Seconds of processor time of all its threads together; 0 = no limit. A signal ends it then.
    uint64_t processor_seconds_limit = 0;
    /// Where the kernel has Landlock, the program uses these files alone, opens no connection over
    /// TCP and sends no signal to other processes. Empty: no such limits.
    std::span<const FileAccess> files = {};
    /// Which process the system ends first if memory runs out: 0 = as this one, 1000 = the first.
    int out_of_memory_score = 0;
    /// It is killed after this time; 0 = never.
    std::chrono::milliseconds time_limit{0};

    /// Bytes of stdout that are kept; the rest is read and dropped.
    size_t output_limit = SIZE_MAX;
    /// Bytes of stderr that are kept: the last ones.
    size_t error_limit = size_t{1} << 16;
    /// Called with all of the kept stdout whenever it has grown; an error kills the process.
    std::function<Status(std::span<const std::byte>)> check_output = {};
    /// Called about 50 times a second on the calling thread; true kills the process.
    std::function<bool()> is_cancelled = {};

    /// The program without its folder, which starts the messages of errors.
    [[nodiscard]] std::string name() const;
};

/// How a process ended, and what it wrote.
struct ProcessResult {
    enum class End : uint8_t { Exited, Signalled, TimedOut, Cancelled };

    End end = End::Exited;
    /// The exit code if it exited, the number of the signal if one ended it.
    int code = 0;
    std::vector<std::byte> output;
    std::string errors;

    [[nodiscard]] bool succeeded() const { return end == End::Exited && code == 0; }

    /// "ended with exit code 3", "ended by signal 11 (Segmentation fault)". Precondition: it did
    /// not succeed.
    [[nodiscard]] std::string failure() const;

    /// The last line of stderr that is not empty.
    [[nodiscard]] std::string last_error_line() const;

    [[nodiscard]] std::string_view output_text() const {
        return {reinterpret_cast<const char*>(output.data()), output.size()};
    }
};

/// Runs a program until it ends. It writes no core file and cannot gain privileges
/// (`no_new_privs`). A program that has exited may leave others running: nothing waits for those.
/// The child dies with the calling thread. Thread-safe.
///
/// Returns an error, and leaves no process, if the program cannot be started or `check_output`
/// refuses its output. Every other end is a result.
[[nodiscard]] Result<ProcessResult> run_process(const ProcessCommand& command);

}  // namespace tetralight
