// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// How the samples of a probe are divided into rounds, and rounds into independent estimates. The
/// same for every probe, so that a probe does not depend on the others.
class RoundPlan {
  public:
    /// Estimates per round if it has enough samples: their standard error is itself accurate to
    /// about a tenth.
    static constexpr uint32_t kEstimateCount = 8;
    /// With fewer samples, a direction set is too uneven to be split into more estimates.
    static constexpr uint32_t kMinSamplesPerEstimate = 16;

    /// Precondition: `check(settings)` succeeds.
    explicit RoundPlan(const BakeSettings& settings,
                       ErrorMeasure measure = ErrorMeasure::AllNormals) noexcept;

    /// Returns invalid_argument with the setting as its field if there are no samples, if the
    /// maximum is below the samples of the first round, or if a number is negative or not finite.
    [[nodiscard]] static Status check(const BakeSettings& settings);

    /// Samples of the first round, which with rounds are enough for a standard error.
    [[nodiscard]] static uint64_t first_round_samples(const BakeSettings& settings) noexcept;

    /// Samples that a probe has before a round: each round doubles them, up to the maximum.
    [[nodiscard]] uint64_t samples_before(uint64_t round) const noexcept;

    /// Samples of one round; 0 if the plan has no such round.
    [[nodiscard]] uint64_t samples_in_round(uint64_t round) const noexcept;

    /// Number of estimates that the samples of a round are divided into.
    [[nodiscard]] uint32_t estimates_in_round(uint64_t round) const noexcept;

    /// Samples of one of these estimates. Within a round they differ by at most one.
    [[nodiscard]] uint32_t samples_in_estimate(uint64_t round, uint32_t estimate) const noexcept;

    /// Of the errors that are compared with the targets.
    [[nodiscard]] ErrorMeasure measure() const noexcept { return measure_; }

    /// True if the errors of layers count (`BakeSettings::target_layer_error`).
    [[nodiscard]] bool has_layer_target() const noexcept { return target_layer_error_ > 0.0; }

    /// True if there is a target error, of all light or of layers.
    [[nodiscard]] bool has_target() const noexcept {
        return target_error_ > 0.0 || target_layer_error_ > 0.0;
    }

    /// True if there is a target and the probe has reached it. `layer_error`: as of `is_done`.
    [[nodiscard]] bool is_at_target(const ProbeAccumulator& accumulator,
                                    float layer_error = 0.0f) const noexcept;

    /// Samples of a probe that has all rounds of the plan.
    [[nodiscard]] uint64_t max_samples() const noexcept { return max_samples_; }

    /// True if the probe needs no further round. `layer_error`: that of its worst layer, if the
    /// plan has a target for layers.
    [[nodiscard]] bool is_done(const ProbeAccumulator& accumulator,
                               float layer_error = 0.0f) const noexcept;

    /// Samples that the probe is expected to have when it is done, from its errors so far.
    [[nodiscard]] uint64_t expected_samples(const ProbeAccumulator& accumulator,
                                            float layer_error = 0.0f) const noexcept;

  private:
    /// The larger of both errors, each divided by its target; at most 1 if the targets are reached.
    [[nodiscard]] double excess(const ProbeAccumulator& accumulator,
                                float layer_error) const noexcept;

    uint64_t first_round_samples_ = 0;
    uint64_t max_samples_ = 0;
    double target_error_ = 0.0;
    double target_layer_error_ = 0.0;
    ErrorMeasure measure_ = ErrorMeasure::AllNormals;
};

/// The random key of one estimate of a probe.
[[nodiscard]] uint64_t estimate_key(uint64_t probe_key, uint64_t round, uint32_t estimate) noexcept;

}  // namespace tetralight
