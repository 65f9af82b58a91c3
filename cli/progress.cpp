// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/progress.h>

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include <tetralight/cli/amounts.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {
namespace {

constexpr int kBarWidth = 32;

/// Of this process, which runs one command.
ProgressLines g_lines = ProgressLines::Plain;

double ray_rate(const BakeProgress& progress, double seconds) {
    return static_cast<double>(progress.ray_count) / std::max(seconds, 1e-9);
}

}  // namespace

void set_progress_lines(ProgressLines lines) {
    g_lines = lines;
}

BakeProgressDisplay::BakeProgressDisplay(bool is_quiet, double time_budget_seconds,
                                         ProgressFile* file)
    : is_quiet_(is_quiet),
      time_budget_seconds_(time_budget_seconds),
      file_(file),
      is_terminal_(::isatty(STDERR_FILENO) == 1) {}

BakeProgressDisplay::~BakeProgressDisplay() {
    if (is_bar_drawn_) std::cerr << '\n';
}

double BakeProgressDisplay::fraction_done(const BakeProgress& progress, double seconds) const {
    if (progress.probe_count == 0) return 1.0;
    // The first round always ends.
    const bool is_over_budget = seconds >= time_budget_seconds_;
    if (time_budget_seconds_ == 0.0 || is_over_budget) return progress.fraction_done;
    return std::max(progress.fraction_done, seconds / time_budget_seconds_);
}

std::optional<double> BakeProgressDisplay::seconds_left(const BakeProgress& progress,
                                                        double seconds) const {
    const double fraction = fraction_done(progress, seconds);
    if (fraction <= first_fraction_) return std::nullopt;
    return seconds * (1.0 - fraction) / (fraction - first_fraction_);
}

std::string BakeProgressDisplay::summary(const BakeProgress& progress, double seconds) const {
    const ProgressUnit unit = file_ == nullptr ? ProgressUnit{} : file_->unit();
    std::string line = grouped(progress.probes_done) + "/" + grouped(progress.probe_count) + " " +
                       unit.plural + ", " + magnitude(ray_rate(progress, seconds)) + "rays/s";
    if (progress.has_target)
        line += ", " + grouped(progress.probes_at_target) + " at the target error (" +
                percent(share_at_target(progress)) + ")";
    if (progress.worst_error > 0.0f) line += ", worst error " + percent(progress.worst_error);
    const auto left = seconds_left(progress, seconds);
    if (left && *left > 0.0) line += ", " + duration(*left) + " left";
    return line;
}

bool BakeProgressDisplay::show(const BakeProgress& progress) {
    if (first_fraction_ < 0.0) first_fraction_ = progress.fraction_done;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    if (file_ != nullptr) {
        file_->show(progress, {elapsed.count(), ray_rate(progress, elapsed.count()),
                               seconds_left(progress, elapsed.count())});
    }
    if (!is_quiet_) {
        if (is_terminal_) {
            draw_bar(progress, elapsed.count());
        } else {
            print_line(progress, elapsed.count());
        }
    }
    return Interrupt::signal() == 0;
}

void BakeProgressDisplay::draw_bar(const BakeProgress& progress, double seconds) {
    if (seconds < 1.0 && !is_bar_drawn_) return;
    is_bar_drawn_ = true;
    const int filled = static_cast<int>(fraction_done(progress, seconds) * kBarWidth);
    std::cerr << "\r[" << std::string(filled, '#') << std::string(kBarWidth - filled, '.') << "] "
              << summary(progress, seconds) << "\x1b[K" << std::flush;
}

void BakeProgressDisplay::print_line(const BakeProgress& progress, double seconds) {
    const int tenth = static_cast<int>(fraction_done(progress, seconds) * 10.0);
    if (seconds < 1.0 || tenth == last_tenth_) return;
    last_tenth_ = tenth;
    if (g_lines == ProgressLines::OpenJd) {
        std::cout << "openjd_progress: " << tenth * 10
                  << "\nopenjd_status: " << summary(progress, seconds) << std::endl;
        return;
    }
    std::cerr << "Progress: " << tenth * 10 << "%, " << summary(progress, seconds) << '\n';
}

}  // namespace tetralight::cli
