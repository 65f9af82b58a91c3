// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include <tetralight/bake/placement/adaptive_grid.h>
#include <tetralight/cli/progress.h>

namespace tetralight::cli {

/// Shows the progress of an adaptive grid on stderr: one line a round, which on a terminal replaces
/// the previous line; nothing when quiet. Ctrl-C and SIGTERM end the grid.
class GridProgressDisplay {
  public:
    explicit GridProgressDisplay(bool is_quiet);
    ~GridProgressDisplay();
    GridProgressDisplay(const GridProgressDisplay&) = delete;
    GridProgressDisplay& operator=(const GridProgressDisplay&) = delete;

    /// Called by the generator; false after a signal.
    bool show(const AdaptiveProgress& progress);

  private:
    BakeProgressDisplay signals_{true, 0.0};  // quiet; it catches signals
    bool is_quiet_;
    bool is_terminal_;
    bool is_line_open_ = false;
    uint32_t last_round_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tetralight::cli
