// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/estimate_rays.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include <tetralight/base/error_text.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

double sum(std::span<const double> costs, const PlaceRange& range) {
    return std::accumulate(costs.begin() + range.begin, costs.begin() + range.end, 0.0);
}

/// One after the other, from the first to the last place.
void expect_cover(const std::vector<PlaceRange>& ranges, uint32_t count) {
    uint32_t next = 0;
    for (const PlaceRange& range : ranges) {
        EXPECT_EQ(range.begin, next);
        EXPECT_GT(range.end, range.begin);
        next = range.end;
    }
    EXPECT_EQ(next, count);
}

TEST(CutRanges, HaveTheSameCostUpToOnePlace) {
    std::vector<double> costs;
    for (int i = 0; i < 1000; ++i) costs.push_back(1.0 + i % 7 + (i > 900 ? 30.0 : 0.0));
    const auto ranges = cut_ranges(costs, 13);
    ASSERT_EQ(ranges.size(), 13u);
    expect_cover(ranges, 1000);
    const double mean = sum(costs, {0, 1000}) / 13.0;
    for (const PlaceRange& range : ranges) EXPECT_NEAR(sum(costs, range), mean, 37.0);
}

TEST(CutRanges, EachHasAPlace) {
    const std::vector<double> costs{100.0, 0.0, 0.0, 0.0, 0.0};
    expect_cover(cut_ranges(costs, 5), 5);
    EXPECT_EQ(cut_ranges(costs, 9).size(), 5u);
    expect_cover(cut_ranges({{0.0, 0.0, 0.0, 0.0, 50.0}}, 3), 5);
    expect_cover(cut_ranges(std::vector<double>(4, 0.0), 2), 4);
}

TEST(CutRanges, WithoutPlacesThereIsOneEmptyRange) {
    EXPECT_EQ(cut_ranges({}, 4), std::vector<PlaceRange>(1));
}

class EstimateRays : public testing::Test {
  protected:
    EstimateRays() {
        test::add_box(scene, test::diffuse({0.8f, 0.6f, 0.4f}), test::Facing::Inward, {-2, -2, -2},
                      {2, 2, 2});
        test::add_point_light(scene, LightMode::Mixed, {3, 2, 1}, {0.5f, 1.5f, 0.5f});
        positions = test::random_positions(300, 1);
        std::ranges::sort(positions, {}, [](const glm::dvec3& position) { return position.x; });
    }

    /// The estimate over the rays of the bake itself.
    [[nodiscard]] double ratio(const BakeSettings& settings) const {
        const auto estimate = estimate_rays(scene, {positions}, settings, {});
        EXPECT_TRUE(estimate) << error_text(estimate.error());
        EXPECT_EQ(estimate->rays.size(), positions.size());
        EXPECT_GT(estimate->rays_per_second, 0.0);
        std::vector<ProbeAccumulator> accumulators(positions.size());
        EXPECT_TRUE(bake_accumulators(scene, {positions}, settings, accumulators));
        uint64_t rays = 0;
        for (const ProbeAccumulator& accumulator : accumulators) rays += accumulator.ray_count;
        return estimate->sum() / static_cast<double>(rays);
    }

    Scene scene;
    std::vector<glm::dvec3> positions;
};

TEST_F(EstimateRays, AreThoseOfABakeWithAFixedNumberOfSamples) {
    BakeSettings settings;
    settings.sample_count = 256;
    EXPECT_NEAR(ratio(settings), 1.0, 0.05);
}

TEST_F(EstimateRays, AreThoseOfABakeToATargetError) {
    BakeSettings settings;
    settings.sample_count = 128;
    settings.target_error = 0.03;
    settings.max_sample_count = 1u << 12;
    EXPECT_NEAR(ratio(settings), 1.0, 0.4);
}

TEST_F(EstimateRays, WithoutPlacesAreNone) {
    const auto estimate = estimate_rays(scene, {}, {}, {});
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->sum(), 0.0);
}

}  // namespace
}  // namespace tetralight
