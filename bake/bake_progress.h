// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace tetralight {

struct BakeProgress {
    /// Probes that need no more rays.
    size_t probes_done = 0;
    size_t probe_count = 0;
    /// Rays of this run.
    uint64_t ray_count = 0;
    /// Of the directions that all probes will take, as far as their errors notify by now, in [0,
    /// 1].
    double fraction_done = 0.0;
    /// The largest standard error of a probe so far, as a share of its irradiance.
    float worst_error = 0.0f;
};

/// Called now and then, from any thread but never from two at once; false cancels the bake.
using BakeCallback = std::function<bool(const BakeProgress&)>;

/// Counts work from all threads and passes it on a few times a second.
class ProgressReporter {
  public:
    ProgressReporter(const BakeCallback& callback, size_t probe_count)
        : callback_(callback), probe_count_(probe_count) {}

    /// A probe that has `directions` of the `expected` ones from before.
    void resume_probe(uint64_t directions, uint64_t expected, bool is_done);

    /// A probe's round is over: it now has `directions` more, of `expected`, which were
    /// `expected_before`.
    struct Round {
        uint64_t directions = 0;
        uint64_t expected = 0;
        uint64_t expected_before = 0;
        bool is_first = false;
        bool is_done = false;
        float standard_error = 0.0f;
    };

    void add_round(const Round& round);

    /// Counts rays, and reports when it is time to.
    void add_rays(uint64_t rays);

    /// Errors of probes that wait for their next round, or are done.
    void set_worst_error(float error) { worst_error_ = error; }

    [[nodiscard]] bool is_cancelled() const { return is_cancelled_; }

    /// The last report: all is done.
    void finish();

  private:
    [[nodiscard]] BakeProgress progress() const;

    const BakeCallback& callback_;
    size_t probe_count_;
    std::atomic<size_t> probes_begun_ = 0;
    std::atomic<size_t> probes_done_ = 0;
    std::atomic<uint64_t> ray_count_ = 0;
    std::atomic<uint64_t> directions_ = 0;
    std::atomic<uint64_t> expected_directions_ = 0;  ///< of the probes that have begun
    std::atomic<float> worst_error_ = 0.0f;
    std::atomic<bool> is_cancelled_ = false;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point last_report_{};
};

}  // namespace tetralight
