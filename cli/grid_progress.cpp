// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_progress.h>

#include <unistd.h>

#include <iostream>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

GridProgressDisplay::GridProgressDisplay(bool is_quiet)
    : is_quiet_(is_quiet), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

GridProgressDisplay::~GridProgressDisplay() {
    if (is_line_open_) std::cerr << '\n';
}

bool GridProgressDisplay::show(const AdaptiveProgress& progress) {
    const bool is_new = progress.round != last_round_;
    last_round_ = progress.round;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    if (is_new && !is_quiet_ && elapsed.count() >= 1.0) {
        const std::string line =
            str_cat("round ", progress.round, progress.is_removing ? ", removing: " : ": ",
                    counted(progress.probe_count, "probe"), ", error ", percent(progress.error),
                    ", ", duration(elapsed.count()));
        if (is_terminal_) {
            std::cerr << '\r' << line << "\x1b[K" << std::flush;
            is_line_open_ = true;
        } else {
            std::cerr << "Progress: " << line << '\n';
        }
    }
    return Interrupt::signal() == 0;
}

}  // namespace tetralight::cli
