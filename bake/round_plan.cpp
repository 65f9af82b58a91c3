// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/round_plan.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tetralight/bake/sampling/mix.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr uint64_t kMinSamplesForError =
    uint64_t{RoundPlan::kEstimateCount} * RoundPlan::kMinSamplesPerEstimate;
constexpr uint64_t kDefaultGrowth = 64;
constexpr uint64_t kMaxSamples = uint64_t{1} << 34;  // the samples of one estimate fit in 32 bits
constexpr uint64_t kMaxRounds = 32;

bool has_rounds(const BakeSettings& settings) {
    return settings.target_error > 0.0 || settings.target_layer_error > 0.0 ||
           settings.time_budget_seconds > 0.0 || settings.max_sample_count > settings.sample_count;
}

}  // namespace

RoundPlan::RoundPlan(const BakeSettings& settings, ErrorMeasure measure) noexcept
    : first_round_samples_(first_round_samples(settings)),
      max_samples_(first_round_samples_),
      target_error_(settings.target_error),
      target_layer_error_(settings.target_layer_error),
      measure_(measure) {
    if (!has_rounds(settings)) return;
    const uint64_t wanted = settings.max_sample_count > 0 ? settings.max_sample_count
                                                          : kDefaultGrowth * first_round_samples_;
    max_samples_ = std::min(wanted, kMaxSamples);
}

uint64_t RoundPlan::first_round_samples(const BakeSettings& settings) noexcept {
    return has_rounds(settings) ? std::max<uint64_t>(settings.sample_count, kMinSamplesForError)
                                : settings.sample_count;
}

Status RoundPlan::check(const BakeSettings& settings) {
    if (settings.sample_count == 0) {
        return Error{ErrorCode::InvalidArgument, "samples", "0", "samples: must be at least 1"};
    }
    const std::pair<const char*, double> numbers[] = {
        {"target_error", settings.target_error},
        {"target_layers", settings.target_layer_error},
        {"time_budget", settings.time_budget_seconds},
        {"clamp", static_cast<double>(settings.clamp)}};
    for (const auto& [name, number] : numbers) {
        if (std::isfinite(number) && number >= 0.0) continue;
        return Error{ErrorCode::InvalidArgument, name, str_cat(number),
                     str_cat(name, ": ", number, " is not a finite number of at least 0")};
    }
    const uint64_t maximum = settings.max_sample_count;
    if (has_rounds(settings) && maximum > 0 && maximum < first_round_samples(settings)) {
        return Error{ErrorCode::InvalidArgument, "max_samples", str_cat(maximum),
                     str_cat("max_samples: ", maximum, " is less than the ",
                             first_round_samples(settings), " samples of the first round")};
    }
    return Ok{};
}

uint64_t RoundPlan::samples_before(uint64_t round) const noexcept {
    if (round == 0) return 0;
    if (round > kMaxRounds) return max_samples_;
    return std::min(first_round_samples_ << (round - 1), max_samples_);
}

uint64_t RoundPlan::samples_in_round(uint64_t round) const noexcept {
    const uint64_t samples = samples_before(round + 1) - samples_before(round);
    // The samples left up to the maximum may be too few for a standard error.
    return round > 0 && samples < kMinSamplesForError ? 0 : samples;
}

uint32_t RoundPlan::estimates_in_round(uint64_t round) const noexcept {
    return static_cast<uint32_t>(
        std::clamp<uint64_t>(samples_in_round(round) / kMinSamplesPerEstimate, 1, kEstimateCount));
}

uint32_t RoundPlan::samples_in_estimate(uint64_t round, uint32_t estimate) const noexcept {
    const uint64_t samples = samples_in_round(round), estimates = estimates_in_round(round);
    return static_cast<uint32_t>(samples / estimates + (estimate < samples % estimates));
}

double RoundPlan::excess(const ProbeAccumulator& accumulator, float layer_error) const noexcept {
    double excess = 0.0;
    if (target_error_ > 0.0) excess = double{accumulator.sampling_error(measure_)} / target_error_;
    if (target_layer_error_ > 0.0) {
        excess = std::max(excess, double{layer_error} / target_layer_error_);
    }
    return excess;
}

bool RoundPlan::is_at_target(const ProbeAccumulator& accumulator,
                             float layer_error) const noexcept {
    return has_target() && accumulator.round_count > 0 && excess(accumulator, layer_error) <= 1.0;
}

bool RoundPlan::is_done(const ProbeAccumulator& accumulator, float layer_error) const noexcept {
    if (accumulator.round_count == 0) return false;
    if (is_at_target(accumulator, layer_error)) return true;
    return samples_in_round(accumulator.round_count) == 0;
}

uint64_t RoundPlan::expected_samples(const ProbeAccumulator& accumulator,
                                     float layer_error) const noexcept {
    if (accumulator.round_count == 0) return first_round_samples_;
    if (is_done(accumulator, layer_error)) return accumulator.sample_count;
    if (!has_target()) return max_samples_;
    // The error falls at least with the square root of the number of samples.
    const double ratio = excess(accumulator, layer_error);
    const double needed = static_cast<double>(accumulator.sample_count) * ratio * ratio;
    if (needed >= static_cast<double>(max_samples_)) return max_samples_;
    uint64_t round = 1;
    while (static_cast<double>(samples_before(round)) < needed) ++round;
    return samples_before(round);
}

uint64_t estimate_key(uint64_t probe_key, uint64_t round, uint32_t estimate) noexcept {
    const uint64_t number = round * RoundPlan::kEstimateCount + estimate;
    return detail::mix(probe_key + detail::mix(number + detail::kGoldenRatio64));
}

}  // namespace tetralight
