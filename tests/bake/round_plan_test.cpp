// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/round_plan.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace tetralight {
namespace {

BakeSettings settings(uint32_t samples, double target_error = 0.0, uint64_t max_samples = 0) {
    BakeSettings result;
    result.sample_count = samples;
    result.target_error = target_error;
    result.max_sample_count = max_samples;
    return result;
}

std::vector<uint64_t> rounds(const RoundPlan& plan) {
    std::vector<uint64_t> directions;
    for (uint64_t round = 0; plan.samples_in_round(round) > 0; ++round) {
        directions.push_back(plan.samples_in_round(round));
    }
    return directions;
}

/// A probe after one round whose relative standard error is this.
ProbeAccumulator with_error(const RoundPlan& plan, double error) {
    ProbeAccumulator accumulator;
    accumulator.sample_count = plan.samples_in_round(0);
    accumulator.round_count = 1;
    const auto count = static_cast<double>(accumulator.sample_count);
    accumulator.radiance_sum[0].x = count;
    accumulator.variance_sum = std::pow(error * count * 3.14159265358979, 2.0);
    return accumulator;
}

TEST(RoundPlan, TheErrorOfTheWorstLayerCountsIfItHasATarget) {
    BakeSettings both = settings(1024, 0.01, 65536);
    both.target_layer_error = 0.05;
    const RoundPlan plan(both);
    EXPECT_TRUE(plan.has_layer_target());
    EXPECT_TRUE(plan.is_done(with_error(plan, 0.009), 0.049f));
    EXPECT_FALSE(plan.is_done(with_error(plan, 0.009), 0.051f));
    EXPECT_FALSE(plan.is_done(with_error(plan, 0.011), 0.0f));
    EXPECT_EQ(plan.expected_samples(with_error(plan, 0.009), 0.19f), 16u * 1024);  // (19/5)² = 14.4
    both.target_error = 0.0;
    EXPECT_TRUE(RoundPlan(both).is_done(with_error(plan, 1.0), 0.049f));
    EXPECT_FALSE(RoundPlan(settings(1024, 0.01)).has_layer_target());
    both.target_layer_error = -1.0;
    EXPECT_EQ(RoundPlan::check(both).error().field, "target_layers");
}

TEST(RoundPlan, WithoutATargetThereIsOneRoundOfEightEstimates) {
    const RoundPlan plan(settings(1024));
    EXPECT_EQ(rounds(plan), std::vector<uint64_t>{1024});
    EXPECT_EQ(plan.estimates_in_round(0), 8u);
    EXPECT_EQ(plan.samples_in_estimate(0, 7), 128u);
}

TEST(RoundPlan, EstimatesDivideAllSamples) {
    for (const uint32_t samples : {1u, 15u, 16u, 31u, 32u, 100u, 127u, 128u, 1000u, 1u << 24}) {
        const RoundPlan plan(settings(samples));
        uint64_t sum = 0;
        for (uint32_t i = 0; i < plan.estimates_in_round(0); ++i) {
            EXPECT_GT(plan.samples_in_estimate(0, i), 0u);
            sum += plan.samples_in_estimate(0, i);
        }
        EXPECT_EQ(sum, samples);
    }
}

TEST(RoundPlan, FewSamplesAreFewerEstimates) {
    EXPECT_EQ(RoundPlan(settings(1)).estimates_in_round(0), 1u);
    EXPECT_EQ(RoundPlan(settings(31)).estimates_in_round(0), 1u);
    EXPECT_EQ(RoundPlan(settings(32)).estimates_in_round(0), 2u);
    EXPECT_EQ(RoundPlan(settings(128)).estimates_in_round(0), 8u);
}

TEST(RoundPlan, RoundsDoubleTheSamplesUpToTheMaximum) {
    EXPECT_EQ(rounds(RoundPlan(settings(1024, 0.01, 5000))),
              (std::vector<uint64_t>{1024, 1024, 2048, 904}));
    EXPECT_EQ(rounds(RoundPlan(settings(1024, 0.01, 4100))),  // 4 are too few for a round
              (std::vector<uint64_t>{1024, 1024, 2048}));
    EXPECT_EQ(RoundPlan(settings(1024, 0.01)).samples_before(100), 65536u);
}

TEST(RoundPlan, WithATargetTheFirstRoundHasEightEstimates) {
    EXPECT_EQ(RoundPlan(settings(1, 0.01)).samples_in_round(0), 128u);
}

TEST(RoundPlan, AProbeIsDoneBelowTheTargetOrAtTheMaximum) {
    const RoundPlan plan(settings(1024, 0.01, 2048));
    EXPECT_FALSE(plan.is_done({}));
    EXPECT_FALSE(plan.is_done(with_error(plan, 0.0101)));
    EXPECT_TRUE(plan.is_done(with_error(plan, 0.0099)));
    ProbeAccumulator last = with_error(plan, 0.5);
    last.round_count = 2;
    EXPECT_TRUE(plan.is_done(last));
}

TEST(RoundPlan, WithOnlyATimeBudgetRoundsContinueToTheMaximum) {
    BakeSettings with_budget = settings(1024);
    with_budget.time_budget_seconds = 1.0;
    const RoundPlan plan(with_budget);
    EXPECT_FALSE(plan.is_done(with_error(plan, 1e-6)));
}

TEST(RoundPlan, AMaximumAloneGivesRounds) {
    const RoundPlan plan(settings(128, 0.0, 512));
    EXPECT_EQ(plan.samples_before(1), 128u);
    EXPECT_EQ(plan.samples_before(2), 256u);
    EXPECT_EQ(plan.samples_before(3), 512u);
    EXPECT_EQ(plan.samples_in_round(3), 0u);
    EXPECT_FALSE(plan.is_at_target(with_error(plan, 0.0)));
}

TEST(RoundPlan, ExpectsErrorsToFallWithTheRootOfTheSamples) {
    const RoundPlan plan(settings(1024, 0.01));
    EXPECT_EQ(plan.expected_samples({}), 1024u);
    EXPECT_EQ(plan.expected_samples(with_error(plan, 0.005)), 1024u);
    EXPECT_EQ(plan.expected_samples(with_error(plan, 0.0199)), 4096u);
    EXPECT_EQ(plan.expected_samples(with_error(plan, 5.0)), 65536u);
}

TEST(RoundPlan, RejectsSettingsOutOfRange) {
    EXPECT_EQ(error_text(RoundPlan::check(settings(0)).error()), "samples: must be at least 1");
    EXPECT_EQ(error_text(RoundPlan::check(settings(1, -1.0)).error()),
              "target_error: -1 is not a finite number of at least 0");
    EXPECT_FALSE(RoundPlan::check(settings(1, std::nan(""))));
    EXPECT_EQ(error_text(RoundPlan::check(settings(1024, 0.01, 1000)).error()),
              "max_samples: 1000 is less than the 1024 samples of the first round");
    EXPECT_TRUE(RoundPlan::check(settings(1024, 0.0, 1000)));  // no rounds, no maximum
}

TEST(RoundPlan, EveryEstimateHasADistinctKey) {
    std::set<uint64_t> keys;
    for (uint64_t probe = 0; probe < 100; ++probe) {
        for (uint64_t round = 0; round < 8; ++round) {
            for (uint32_t i = 0; i < 8; ++i) keys.insert(estimate_key(probe, round, i));
        }
    }
    EXPECT_EQ(keys.size(), 6400u);
}

}  // namespace
}  // namespace tetralight
