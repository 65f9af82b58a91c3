// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// How the directions of a probe are split into rounds, and rounds into independent estimates. The
/// same for every probe, so that what a probe gets depends on nothing but itself.
class RoundPlan {
  public:
    /// Estimates of a round that has directions for them: enough for a standard error that is
    /// itself good to about a tenth.
    static constexpr uint32_t kEstimateCount = 8;
    /// Sets of fewer directions are too uneven to be worth more estimates.
    static constexpr uint32_t kMinSamplesPerEstimate = 16;

    /// Precondition: `check(settings)` holds.
    explicit RoundPlan(const BakeSettings& settings) noexcept;

    /// Error: no samples, fewer at most than at first, numbers that are negative or NaN.
    [[nodiscard]] static Status check(const BakeSettings& settings);

    /// Directions that a probe has before this round: each round doubles them, up to the maximum.
    [[nodiscard]] uint64_t samples_before(uint64_t round) const noexcept;

    /// Directions of one round; 0: there is no such round.
    [[nodiscard]] uint64_t samples_in_round(uint64_t round) const noexcept;

    /// Estimates that share them.
    [[nodiscard]] uint32_t estimates_in_round(uint64_t round) const noexcept;

    /// Directions of one of these estimates; they differ by one at most.
    [[nodiscard]] uint32_t samples_in_estimate(uint64_t round, uint32_t estimate) const noexcept;

    /// Whether the probe needs no further round.
    [[nodiscard]] bool is_done(const ProbeAccumulator& accumulator) const noexcept;

    /// Directions that the probe will have when it is done, as far as its error tells by now.
    [[nodiscard]] uint64_t expected_samples(const ProbeAccumulator& accumulator) const noexcept;

  private:
    uint64_t first_ = 0;
    uint64_t maximum_ = 0;
    double target_error_ = 0.0;
};

/// Key of one estimate of a probe.
[[nodiscard]] uint64_t estimate_key(uint64_t probe_key, uint64_t round, uint32_t estimate) noexcept;

}  // namespace tetralight
