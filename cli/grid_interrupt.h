// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tetralight::cli {

/// While it lives, Ctrl-C and SIGTERM end the program at once, with one line on stderr, with
/// `is_json` an object on stdout too, and the exit code of the signal: for work that keeps nothing.
/// At most one at a time.
class GridInterrupt {
  public:
    GridInterrupt(const std::string& line, bool is_json);
    ~GridInterrupt();
    GridInterrupt(const GridInterrupt&) = delete;
    GridInterrupt& operator=(const GridInterrupt&) = delete;
};

}  // namespace tetralight::cli
