// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/fit_edge_ratios.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <utility>

namespace tetralight {
namespace {

/// A probe at distance 1 from a wall. Its neighbors stand at distances `heights` from it towards
/// the wall, which blocks those above 1: their edge ratio is the height. Along free edges the plane
/// asks for a ratio of the height as well.
class PlanarWall {
  public:
    explicit PlanarWall(std::vector<double> heights) : heights_(std::move(heights)) {}

    /// A face of three neighbors and a position on it.
    void add_sample(const std::array<uint32_t, 3>& corners, const std::array<double, 3>& weights) {
        RatioSample sample;
        double height = 0.0;
        for (size_t k = 0; k < 3; ++k) {
            const double part = weights[k] * heights_[corners[k]];
            height += part;
            if (heights_[corners[k]] > 1.0) {
                sample.known += part;
            } else {
                sample.edges[k] = corners[k];
                sample.weights[k] = weights[k];
            }
        }
        if (height > 1.0) sample.ratio = height;
        samples_.push_back(sample);
    }

    [[nodiscard]] std::vector<double> fit() const {
        return fit_edge_ratios(heights_.size(), samples_);
    }

  private:
    std::vector<double> heights_;
    std::vector<RatioSample> samples_;
};

std::array<double, 3> random_weights(std::mt19937_64& engine) {
    std::exponential_distribution<double> part;
    std::array<double, 3> weights{part(engine), part(engine), part(engine)};
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& weight : weights) weight /= sum;
    return weights;
}

TEST(FitEdgeRatios, FindsThePlaneOfAWall) {
    const std::vector<double> heights{3.0, 2.0, 0.5, -0.5, -2.0, 0.9, 5.0};
    PlanarWall wall(heights);
    std::mt19937_64 engine(1);
    for (int i = 0; i < 300; ++i) {
        std::vector<uint32_t> places(heights.size());
        std::iota(places.begin(), places.end(), 0u);
        std::shuffle(places.begin(), places.end(), engine);
        wall.add_sample({places[0], places[1], places[2]}, random_weights(engine));
    }
    const std::vector<double> ratios = wall.fit();
    for (size_t edge = 0; edge < heights.size(); ++edge) {
        if (heights[edge] <= 1.0) {
            EXPECT_NEAR(ratios[edge], heights[edge], 0.02);
        }
    }
}

TEST(FitEdgeRatios, StaysInRange) {
    RatioSample behind, before;
    behind.edges[0] = 0;
    behind.weights[0] = 0.5;
    behind.known = 20.0;
    before = behind;
    before.known = 0.0;
    before.ratio = 30.0;
    EXPECT_EQ(fit_edge_ratios(1, std::vector{behind}), std::vector{kLeastFreeRatio});
    EXPECT_EQ(fit_edge_ratios(1, std::vector{before}), std::vector{kMostFreeRatio});
}

TEST(FitEdgeRatios, OfEdgesWithoutSamplesIsZero) {
    EXPECT_EQ(fit_edge_ratios(3, {}), std::vector<double>(3, 0.0));
}

TEST(FitEdgeRatios, LeavesFreeRaysAlone) {
    RatioSample sample;  // L = 0.3 + 0.5 r ≤ 1 for r = 0
    sample.edges[0] = 0;
    sample.weights[0] = 0.5;
    sample.known = 0.3;
    EXPECT_EQ(fit_edge_ratios(1, std::vector{sample}), std::vector{0.0});
}

}  // namespace
}  // namespace tetralight
