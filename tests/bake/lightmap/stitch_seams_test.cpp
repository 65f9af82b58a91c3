// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/stitch_seams.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace tetralight {
namespace {

constexpr uint32_t kPageSize = 32;

/// Two vertical edges of 8 texels, at different places within texels.
std::vector<Seam> two_edges() {
    return {{{0, {4.5f, 2.0f}, {4.5f, 10.0f}}, {0, {20.2f, 12.3f}, {20.2f, 20.3f}}}};
}

SeamStitcher stitcher_with(double weight) {
    return {two_edges(), kPageSize, [=](uint64_t) { return weight; }};
}

double mean_square(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return sum / static_cast<double>(values.size());
}

std::vector<double> random_values(size_t count, uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    std::vector<double> values(count);
    for (double& value : values) value = uniform(engine);
    return values;
}

TEST(StitchSeams, EqualLightStays) {
    const SeamStitcher stitcher = stitcher_with(0.05);
    const std::vector<double> values(stitcher.texels().size(), 3.0);
    for (const double difference : stitcher.differences(values)) EXPECT_NEAR(difference, 0.0, 1e-6);
    for (const double value : stitcher.stitched(values)) EXPECT_NEAR(value, 3.0, 1e-6);
}

TEST(StitchSeams, BothSidesAgreeAfterwards) {
    const SeamStitcher stitcher = stitcher_with(0.05);
    const auto values = random_values(stitcher.texels().size(), 1);
    const double before = mean_square(stitcher.differences(values));
    const double after = mean_square(stitcher.differences(stitcher.stitched(values)));
    EXPECT_LT(std::sqrt(after), 0.25 * std::sqrt(before));
}

TEST(StitchSeams, ASideThatResistsMoreChangesLess) {
    // The first edge has texels of columns 4 and 5, the second those of columns 19 and 20.
    const SeamStitcher stitcher(two_edges(), kPageSize, [](uint64_t texel) {
        return texel % kPageSize < 10 ? 10.0 : 0.001;
    });
    std::vector<double> values;
    for (const uint64_t texel : stitcher.texels())
        values.push_back(texel % kPageSize < 10 ? 1.0 : 2.0);
    const auto stitched = stitcher.stitched(values);
    for (size_t i = 0; i < values.size(); ++i) {
        if (values[i] == 1.0) {
            EXPECT_NEAR(stitched[i], 1.0, 0.01);
        }
    }
    EXPECT_LT(mean_square(stitcher.differences(stitched)), 1e-3);
}

TEST(StitchSeams, TheSolutionIsTheLeastSquaresMinimum) {
    const double weight = 0.05;
    const SeamStitcher stitcher = stitcher_with(weight);
    const auto values = random_values(stitcher.texels().size(), 2);
    const auto best = stitcher.stitched(values);
    const auto cost = [&](const std::vector<double>& x) {
        // 17 places on 8 texels: each stands for 16/17 of half a texel.
        double sum = mean_square(stitcher.differences(x)) *
                     static_cast<double>(stitcher.place_count()) * 16.0 / 17.0;
        for (size_t i = 0; i < x.size(); ++i) sum += weight * std::pow(x[i] - values[i], 2);
        return sum;
    };
    for (uint64_t seed = 0; seed < 20; ++seed) {
        auto other = best;
        const auto noise = random_values(best.size(), 100 + seed);
        for (size_t i = 0; i < other.size(); ++i) other[i] += 1e-3 * (noise[i] - 1.0);
        EXPECT_GT(cost(other), cost(best));
    }
}

TEST(StitchSeams, StitchedSumsAreSumsOfStitched) {
    const SeamStitcher stitcher = stitcher_with(0.05);
    const auto a = random_values(stitcher.texels().size(), 3);
    const auto b = random_values(stitcher.texels().size(), 4);
    std::vector<double> sum(a.size());
    for (size_t i = 0; i < a.size(); ++i) sum[i] = a[i] + b[i];
    const auto fa = stitcher.stitched(a), fb = stitcher.stitched(b), fs = stitcher.stitched(sum);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(fa[i] + fb[i], fs[i], 1e-6);
}

TEST(StitchSeams, DarkSidesDoNotBecomeNegative) {
    // A dark side beside one whose light changes from one texel to the next.
    SeamStitcher stitcher = stitcher_with(0.002);
    std::vector<double> values;
    for (const uint64_t texel : stitcher.texels()) {
        const bool is_dark = texel % kPageSize < 10 || texel / kPageSize % 2 == 0;
        values.push_back(is_dark ? 0.0 : 4.0);
    }
    const auto count_negative = [&] {
        return std::ranges::count_if(stitcher.stitched(values), [](double x) { return x < 0.0; });
    };
    EXPECT_GT(count_negative(), 0);
    stitcher.hold_zeros(values);
    EXPECT_EQ(count_negative(), 0);
    EXPECT_LT(mean_square(stitcher.differences(stitcher.stitched(values))),
              0.1 * mean_square(stitcher.differences(values)));
}

TEST(StitchSeams, WithoutSeamsNothingChanges) {
    const SeamStitcher stitcher({}, kPageSize, [](uint64_t) { return 1.0; });
    EXPECT_TRUE(stitcher.texels().empty());
    EXPECT_TRUE(stitcher.stitched({}).empty());
}

}  // namespace
}  // namespace tetralight
