// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_statistics.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(BakeStatistics, OfNothingIsZero) {
    EXPECT_EQ(bake_statistics({}, 0.01), BakeStatistics{});
}

TEST(BakeStatistics, TakesQuantilesOfAllProbes) {
    BakedProbes baked;
    for (int i = 200; i > 0; --i) {
        baked.standard_error.push_back(static_cast<float>(i));
        baked.sampling_error.push_back(static_cast<float>(i) / 2.0f);
        baked.sample_count.push_back(10u * static_cast<unsigned>(i));
    }
    const BakeStatistics statistics = bake_statistics(baked, 75.25);
    EXPECT_EQ(statistics.min_samples, 10u);
    EXPECT_EQ(statistics.median_samples, 1000u);
    EXPECT_EQ(statistics.max_samples, 2000u);
    EXPECT_EQ(statistics.median_error, 100.0f);
    EXPECT_EQ(statistics.p99_error, 198.0f);
    EXPECT_EQ(statistics.worst_error, 200.0f);
    EXPECT_EQ(statistics.over_target_count, 50u);
}

TEST(BakeStatistics, IgnoresUnknownErrors) {
    BakedProbes baked;
    baked.standard_error = {0.0f, 0.25f, 0.0f, 0.5f, 0.0f};
    baked.sample_count.assign(5, 16);
    const BakeStatistics statistics = bake_statistics(baked, 0.0);
    EXPECT_EQ(statistics.known_error_count, 2u);
    EXPECT_EQ(statistics.median_error, 0.25f);
    EXPECT_EQ(statistics.worst_error, 0.5f);
    EXPECT_EQ(statistics.median_samples, 16u);
}

TEST(BakeStatistics, WithoutATargetNoProbeIsOverIt) {
    BakedProbes baked;
    baked.standard_error = {0.5f};
    baked.sample_count = {1};
    EXPECT_EQ(bake_statistics(baked, 0.0).over_target_count, 0u);
}

}  // namespace
}  // namespace tetralight
