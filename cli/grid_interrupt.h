// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tetralight::cli {

/// While it lives, Ctrl-C and SIGTERM end the program at once, with one line on stderr and the exit
/// code of the signal: for work that leaves nothing behind. At most one at a time.
class GridInterrupt {
  public:
    explicit GridInterrupt(const std::string& line);
    ~GridInterrupt();
    GridInterrupt(const GridInterrupt&) = delete;
    GridInterrupt& operator=(const GridInterrupt&) = delete;
};

}  // namespace tetralight::cli
