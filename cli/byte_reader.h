// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/result.h>

namespace tetralight::cli {

/// Reads a file, a pipe or a terminal piece by piece, and knows when it has to wait for more.
class ByteReader {
  public:
    using Action = std::function<Status()>;

    /// `-` is stdin.
    [[nodiscard]] static Result<ByteReader> open(const std::string& path);

    /// What to do whenever there is nothing to read right now: whoever writes to the pipe may wait
    /// for an answer before going on.
    void before_wait(Action action) { before_wait_ = std::move(action); }

    /// Reads the available bytes, at least one; 0 at the end. Returns the errors of the system and
    /// of the action.
    [[nodiscard]] Result<size_t> read(std::span<char> memory);

    /// As messages say it.
    [[nodiscard]] const std::string& name() const { return name_; }

  private:
    ByteReader(std::string name, Descriptor file)
        : name_(std::move(name)), file_(std::move(file)) {}

    [[nodiscard]] bool has_input(int timeout_milliseconds) const;

    std::string name_;
    Descriptor file_;
    Action before_wait_;
};

}  // namespace tetralight::cli
