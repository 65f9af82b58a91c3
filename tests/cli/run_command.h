// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tetralight::test {

/// What a finished command left.
struct CommandResult {
    /// 128 + the signal's number when a signal ended the command, as shells have it.
    int exit_code = -1;
    std::string out;
    std::string err;
    /// The most memory that it held at a time; not less than what this process held at its start.
    long peak_memory_kib = 0;
};

/// The built `tetralight` as a child process. Its three streams are files that nobody else sees, so
/// that no amount of output can block it.
class RunningCommand {
  public:
    RunningCommand(const std::filesystem::path& working_folder,
                   const std::vector<std::string>& arguments, const std::string& input);
    /// Kills the command if nobody waited for it.
    ~RunningCommand();
    RunningCommand(const RunningCommand&) = delete;
    RunningCommand& operator=(const RunningCommand&) = delete;

    [[nodiscard]] CommandResult wait();

    void send(int signal) const;

    /// Whether the command handles this signal itself by now.
    [[nodiscard]] bool handles(int signal) const;

  private:
    using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

    Stream in_;
    Stream out_;
    Stream err_;
    pid_t process_ = -1;
};

/// Runs `tetralight` with `arguments` in a folder to its end.
[[nodiscard]] CommandResult run_command(const std::filesystem::path& working_folder,
                                        const std::vector<std::string>& arguments,
                                        const std::string& input = "");

}  // namespace tetralight::test
