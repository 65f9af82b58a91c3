// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/cli/interrupt.h>
#include <tetralight/cli/progress_file.h>

namespace tetralight::cli {

/// Lines about progress where there is no terminal.
enum class ProgressLines : uint8_t {
    Plain,   ///< "Progress: 40%, ..." on stderr
    OpenJd,  ///< "openjd_progress: 40" on stdout (Open Job Description)
};

/// From now on, of this process.
void set_progress_lines(ProgressLines lines);

/// Shows the progress of a bake on stderr: a bar on a terminal once it takes longer than a second,
/// a plain line for each tenth elsewhere, nothing when quiet; and in a file for other programs.
/// Ctrl-C and SIGTERM cancel the bake.
class BakeProgressDisplay {
  public:
    /// `time_budget_seconds` 0: none. `file` null: none, and probes are counted.
    BakeProgressDisplay(bool is_quiet, double time_budget_seconds, ProgressFile* file = nullptr);
    ~BakeProgressDisplay();
    BakeProgressDisplay(const BakeProgressDisplay&) = delete;
    BakeProgressDisplay& operator=(const BakeProgressDisplay&) = delete;

    /// Called by the bake; false after a signal.
    bool show(const BakeProgress& progress);

  private:
    /// The finished fraction of a bake `seconds` after it began.
    [[nodiscard]] double fraction_done(const BakeProgress& progress, double seconds) const;
    /// Time left at the pace of this run, without what earlier runs did; none while it is
    /// unknown.
    [[nodiscard]] std::optional<double> seconds_left(const BakeProgress& progress,
                                                     double seconds) const;
    [[nodiscard]] std::string summary(const BakeProgress& progress, double seconds) const;
    void draw_bar(const BakeProgress& progress, double seconds);
    void print_line(const BakeProgress& progress, double seconds);

    Interrupt interrupt_;
    bool is_quiet_;
    double time_budget_seconds_;
    ProgressFile* file_;
    double first_fraction_ = -1.0;  ///< finished by earlier runs; negative: unknown
    bool is_terminal_;
    bool is_bar_drawn_ = false;
    int last_tenth_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tetralight::cli
