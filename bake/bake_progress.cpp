// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_progress.h>

#include <algorithm>

namespace tetralight {

void ProgressReporter::resume_probe(uint64_t samples, uint64_t expected_samples, State state) {
    if (samples == 0) return;
    ++probes_begun_;
    probes_done_ += state.is_done;
    probes_at_target_ += state.is_at_target;
    samples_ += samples;
    expected_samples_ += expected_samples;
}

void ProgressReporter::add_round(const Round& round) {
    probes_begun_ += round.is_first;
    probes_done_ += round.state.is_done;
    probes_at_target_ += round.state.is_at_target;
    samples_ += round.samples;
    expected_samples_ +=
        round.expected_samples - (round.is_first ? 0 : round.expected_samples_before);
    float worst = worst_error_;
    while (round.sampling_error > worst &&
           !worst_error_.compare_exchange_weak(worst, round.sampling_error)) {
    }
}

void ProgressReporter::add_rays(uint64_t rays) {
    ray_count_.fetch_add(rays, std::memory_order_relaxed);
    if (!callback_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock() || is_cancelled_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_report_ < std::chrono::milliseconds(50)) return;
    last_report_ = now;
    if (!callback_(progress())) is_cancelled_ = true;
}

void ProgressReporter::finish() {
    if (callback_ && !is_cancelled_) callback_(progress());
}

BakeProgress ProgressReporter::progress() const {
    // Assume that probes without samples need as many as the others.
    const size_t begun = std::max<size_t>(probes_begun_, 1);
    const double expected = static_cast<double>(expected_samples_) *
                            static_cast<double>(probe_count_) / static_cast<double>(begun);
    const double fraction = expected > 0.0 ? static_cast<double>(samples_) / expected : 0.0;
    const bool is_done = probes_done_ == probe_count_;
    return {.probes_done = probes_done_,
            .probe_count = probe_count_,
            .probes_at_target = probes_at_target_,
            .has_target = has_target_,
            .ray_count = ray_count_,
            .fraction_done = is_done ? 1.0 : std::min(fraction, 1.0),
            .worst_error = worst_error_};
}

}  // namespace tetralight
