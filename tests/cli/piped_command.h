// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include <tetralight/base/process/descriptor.h>

namespace tetralight::test {

/// The built `tetralight` between two pipes, as another program would talk with it. What it says on
/// stderr goes to the file `err` of its folder.
class PipedCommand {
  public:
    PipedCommand(const std::filesystem::path& working_folder, std::vector<std::string> arguments);
    /// Kills the command if nobody waited for it.
    ~PipedCommand();
    PipedCommand(const PipedCommand&) = delete;
    PipedCommand& operator=(const PipedCommand&) = delete;

    void write(const std::string& bytes) const;

    /// The next bytes that it writes; none at the end, and when it says nothing for a minute.
    [[nodiscard]] std::string read() const;

    void close_input() { input_.close(); }

    void close_output() { output_.close(); }

    /// Its status as wait() gives it.
    [[nodiscard]] int wait();

  private:
    Descriptor input_;
    Descriptor output_;
    pid_t process_ = -1;
};

}  // namespace tetralight::test
