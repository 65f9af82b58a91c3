// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <unistd.h>

#include <csignal>
#include <iostream>

#include "cli/common.h"

namespace tetralight::cli {
namespace {

constexpr int kBarWidth = 32;

volatile std::sig_atomic_t g_is_interrupted = 0;  // a signal handler can reach nothing else

extern "C" void on_interrupt(int) {
    g_is_interrupted = 1;
    std::signal(SIGINT, SIG_DFL);  // a second Ctrl-C ends the program at once
}

double share_done(const BakeProgress& progress) {
    if (progress.probe_count == 0) return 1.0;
    return static_cast<double>(progress.probes_done) / static_cast<double>(progress.probe_count);
}

std::string summary(const BakeProgress& progress, double seconds) {
    const double share = share_done(progress);
    const double rate = static_cast<double>(progress.ray_count) / std::max(seconds, 1e-9);
    std::string line = grouped(progress.probes_done) + "/" + grouped(progress.probe_count) +
                       " probes, " + magnitude(rate) + "rays/s";
    if (share > 0.0 && share < 1.0)
        line += ", " + duration(seconds * (1.0 / share - 1.0)) + " left";
    return line;
}

}  // namespace

BakeProgressDisplay::BakeProgressDisplay(bool is_quiet)
    : is_quiet_(is_quiet), is_terminal_(::isatty(STDERR_FILENO) == 1) {
    std::signal(SIGINT, on_interrupt);
}

BakeProgressDisplay::~BakeProgressDisplay() {
    if (is_bar_drawn_) std::cerr << '\n';
    std::signal(SIGINT, SIG_DFL);
}

bool BakeProgressDisplay::is_interrupted() {
    return g_is_interrupted != 0;
}

bool BakeProgressDisplay::show(const BakeProgress& progress) {
    if (!is_quiet_) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        if (is_terminal_) {
            draw_bar(progress, elapsed.count());
        } else {
            print_line(progress, elapsed.count());
        }
    }
    return !is_interrupted();
}

void BakeProgressDisplay::draw_bar(const BakeProgress& progress, double seconds) {
    if (seconds < 1.0 && !is_bar_drawn_) return;
    is_bar_drawn_ = true;
    const int filled = static_cast<int>(share_done(progress) * kBarWidth);
    std::cerr << "\r[" << std::string(filled, '#') << std::string(kBarWidth - filled, '.') << "] "
              << summary(progress, seconds) << "\x1b[K" << std::flush;
}

void BakeProgressDisplay::print_line(const BakeProgress& progress, double seconds) {
    const int tenth = static_cast<int>(share_done(progress) * 10.0);
    if (seconds < 1.0 || tenth == last_tenth_) return;
    last_tenth_ = tenth;
    std::cerr << "Progress: " << tenth * 10 << "%, " << summary(progress, seconds) << '\n';
}

}  // namespace tetralight::cli
