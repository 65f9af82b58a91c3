// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "bake/bake_probes.h"

namespace tetralight::cli {

/// Shows how a bake goes on, on stderr: a bar on a terminal once it takes longer than a second, a
/// plain line for each tenth elsewhere, nothing when quiet. Ctrl-C cancels the bake.
class BakeProgressDisplay {
  public:
    explicit BakeProgressDisplay(bool is_quiet);
    ~BakeProgressDisplay();
    BakeProgressDisplay(const BakeProgressDisplay&) = delete;
    BakeProgressDisplay& operator=(const BakeProgressDisplay&) = delete;

    /// To be called by the bake; false after Ctrl-C.
    bool show(const BakeProgress& progress);

    /// Whether the user pressed Ctrl-C since the program began.
    [[nodiscard]] static bool is_interrupted();

  private:
    void draw_bar(const BakeProgress& progress, double seconds);
    void print_line(const BakeProgress& progress, double seconds);

    bool is_quiet_;
    bool is_terminal_;
    bool is_bar_drawn_ = false;
    int last_tenth_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tetralight::cli
