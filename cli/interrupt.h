// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tetralight::cli {

/// While it lives, the first Ctrl-C or SIGTERM is only noted, so that work can be ended and cleaned
/// up; a second one ends the program at once. At most one at a time.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    /// SIGINT or SIGTERM if one of them came since the program began, or else 0.
    [[nodiscard]] static int signal();
};

}  // namespace tetralight::cli
