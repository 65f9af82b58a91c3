// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <utility>

namespace tetralight {

/// Measures wall-clock time from its construction on.
class Stopwatch {
  public:
    /// Seconds since construction or the last `lap`.
    [[nodiscard]] double seconds() const { return seconds_between(start_, Clock::now()); }

    /// The same, and starts again from zero.
    double lap() {
        const auto now = Clock::now();
        return seconds_between(std::exchange(start_, now), now);
    }

  private:
    using Clock = std::chrono::steady_clock;

    static double seconds_between(Clock::time_point begin, Clock::time_point end) {
        return std::chrono::duration<double>(end - begin).count();
    }

    Clock::time_point start_ = Clock::now();
};

}  // namespace tetralight
