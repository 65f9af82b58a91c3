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
    /// Probes that need no further samples.
    size_t probes_done = 0;
    size_t probe_count = 0;
    /// Those that have reached the target errors; 0 without a target.
    size_t probes_at_target = 0;
    bool has_target = false;
    /// Rays traced by this run.
    uint64_t ray_count = 0;
    /// Samples taken over samples expected for all probes, in [0, 1]. The expectation follows from
    /// the errors measured so far.
    double fraction_done = 0.0;
    /// The largest sampling error of a probe so far (`ProbeAccumulator::sampling_error`).
    float worst_error = 0.0f;
};

/// Called a few times per second, from any thread but never from two at a time. Returning false
/// cancels the bake.
using BakeCallback = std::function<bool(const BakeProgress&)>;

/// Collects the progress of all threads and passes it to the callback. Thread-safe.
class ProgressReporter {
  public:
    ProgressReporter(const BakeCallback& callback, size_t probe_count, bool has_target = false)
        : callback_(callback), probe_count_(probe_count), has_target_(has_target) {}

    /// How far a probe is after a round.
    struct State {
        bool is_done = false;
        bool is_at_target = false;
    };

    /// Counts a probe that an earlier run left with `samples` of `expected_samples`.
    void resume_probe(uint64_t samples, uint64_t expected_samples, State state);

    /// A finished round of one probe.
    struct Round {
        uint64_t samples = 0;                  ///< samples of this round
        uint64_t expected_samples = 0;         ///< expected in total, now
        uint64_t expected_samples_before = 0;  ///< expected in total, before this round
        bool is_first = false;
        State state;
        float sampling_error = 0.0f;
    };

    void add_round(const Round& round);

    /// Adds rays, and calls the callback if its last call was at least 50 ms ago.
    void add_rays(uint64_t rays);

    /// Sets the largest error of the probes that are not part of the current batch.
    void set_worst_error(float error) { worst_error_ = error; }

    [[nodiscard]] bool is_cancelled() const { return is_cancelled_; }

    /// Calls the callback a last time.
    void finish();

  private:
    [[nodiscard]] BakeProgress progress() const;

    const BakeCallback& callback_;
    size_t probe_count_;
    bool has_target_;
    std::atomic<size_t> probes_begun_ = 0;
    std::atomic<size_t> probes_done_ = 0;
    std::atomic<size_t> probes_at_target_ = 0;
    std::atomic<uint64_t> ray_count_ = 0;
    std::atomic<uint64_t> samples_ = 0;
    std::atomic<uint64_t> expected_samples_ = 0;  ///< of the probes that have begun
    std::atomic<float> worst_error_ = 0.0f;
    std::atomic<bool> is_cancelled_ = false;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point last_report_{};
};

}  // namespace tetralight
