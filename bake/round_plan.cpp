// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/round_plan.h>

#include <algorithm>
#include <cmath>

#include <tetralight/bake/sampling/mix.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr uint64_t kMinSamplesForError =
    uint64_t{RoundPlan::kEstimateCount} * RoundPlan::kMinSamplesPerEstimate;
constexpr uint64_t kDefaultGrowth = 64;
constexpr uint64_t kMaxSamples = uint64_t{1} << 34;  // an estimate's share fits in 32 bits
constexpr uint64_t kMostRounds = 32;

bool has_rounds(const BakeSettings& settings) {
    return settings.target_error > 0.0 || settings.time_budget_seconds > 0.0;
}

/// A target needs error bars, so rounds begin with directions for them.
uint64_t first_directions(const BakeSettings& settings) {
    return has_rounds(settings) ? std::max<uint64_t>(settings.sample_count, kMinSamplesForError)
                                : settings.sample_count;
}

}  // namespace

RoundPlan::RoundPlan(const BakeSettings& settings) noexcept
    : first_(first_directions(settings)), maximum_(first_), target_error_(settings.target_error) {
    if (!has_rounds(settings)) return;
    const uint64_t wanted =
        settings.max_sample_count > 0 ? settings.max_sample_count : kDefaultGrowth * first_;
    maximum_ = std::min(wanted, kMaxSamples);
}

Status RoundPlan::check(const BakeSettings& settings) {
    if (settings.sample_count == 0) return Error{"samples: 0 is not a number of directions"};
    const auto is_amount = [](double x) { return std::isfinite(x) && x >= 0.0; };
    if (!is_amount(settings.target_error)) {
        return Error{str_cat("target error: ", settings.target_error, " is not a share")};
    }
    if (!is_amount(settings.time_budget_seconds)) {
        return Error{str_cat("time budget: ", settings.time_budget_seconds, " is not a time")};
    }
    if (!is_amount(settings.clamp)) {
        return Error{str_cat("clamp: ", settings.clamp, " is not a radiance")};
    }
    const uint64_t maximum = settings.max_sample_count;
    if (has_rounds(settings) && maximum > 0 && maximum < first_directions(settings)) {
        return Error{str_cat("max samples: ", maximum, " are fewer than the ",
                             first_directions(settings), " of the first round")};
    }
    return Ok{};
}

uint64_t RoundPlan::samples_before(uint64_t round) const noexcept {
    if (round == 0) return 0;
    if (round > kMostRounds) return maximum_;
    return std::min(first_ << (round - 1), maximum_);
}

uint64_t RoundPlan::samples_in_round(uint64_t round) const noexcept {
    const uint64_t directions = samples_before(round + 1) - samples_before(round);
    // What the maximum leaves over may be too little for error bars of its own.
    return round > 0 && directions < kMinSamplesForError ? 0 : directions;
}

uint32_t RoundPlan::estimates_in_round(uint64_t round) const noexcept {
    return static_cast<uint32_t>(
        std::clamp<uint64_t>(samples_in_round(round) / kMinSamplesPerEstimate, 1, kEstimateCount));
}

uint32_t RoundPlan::samples_in_estimate(uint64_t round, uint32_t estimate) const noexcept {
    const uint64_t directions = samples_in_round(round), estimates = estimates_in_round(round);
    return static_cast<uint32_t>(directions / estimates + (estimate < directions % estimates));
}

bool RoundPlan::is_done(const ProbeAccumulator& accumulator) const noexcept {
    if (accumulator.round_count == 0) return false;
    if (target_error_ > 0.0 && accumulator.standard_error() <= target_error_) return true;
    return samples_in_round(accumulator.round_count) == 0;
}

uint64_t RoundPlan::expected_samples(const ProbeAccumulator& accumulator) const noexcept {
    if (accumulator.round_count == 0) return first_;
    if (is_done(accumulator)) return accumulator.sample_count;
    if (target_error_ == 0.0) return maximum_;
    // Errors fall with the root of the directions at least.
    const double excess = accumulator.standard_error() / target_error_;
    const double needed = static_cast<double>(accumulator.sample_count) * excess * excess;
    if (needed >= static_cast<double>(maximum_)) return maximum_;
    uint64_t round = accumulator.round_count + 1;
    while (static_cast<double>(samples_before(round)) < needed) ++round;
    return samples_before(round);
}

uint64_t estimate_key(uint64_t probe_key, uint64_t round, uint32_t estimate) noexcept {
    const uint64_t number = round * RoundPlan::kEstimateCount + estimate;
    return detail::mix(probe_key + detail::mix(number + detail::kGoldenRatio64));
}

}  // namespace tetralight
