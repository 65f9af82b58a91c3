// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/process/descriptor.h>

namespace tetralight::server {

/// Writes to stderr without waiting for its reader. The descriptor itself stays in the mode that it
/// has: other processes may share it.
class LogOutput {
  public:
    LogOutput();

    /// Writes the beginning of a text and returns its length: all of it unless the reader of a
    /// pipe, terminal or socket is slow. A text that cannot be written at all counts as written, as
    /// there is no other place to report that.
    [[nodiscard]] size_t write(std::string_view text);

  private:
    enum class Way : unsigned char {
        File,      ///< never waits for a reader
        Reopened,  ///< `own_` is the same pipe or terminal, in a mode that does not wait
        Socket,
        Polled,  ///< the pipe could not be opened again: small parts after asking for space
    };

    Way way_ = Way::File;
    Descriptor own_;
};

}  // namespace tetralight::server
