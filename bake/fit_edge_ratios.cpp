// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/fit_edge_ratios.h>

#include <algorithm>
#include <cmath>

namespace tetralight {
namespace {

/// Draws ratios that the samples say nothing about to 0.
constexpr double kRegularization = 1e-6;
constexpr int kMostSweeps = 200;
constexpr double kConverged = 1e-3;

/// A sample as seen from one of its edges.
struct Use {
    uint32_t sample = 0;
    double weight = 0.0;
};

/// Minimizes the sum of squared errors of L, relative to it, one ratio after the other. Samples
/// that nothing blocks count while L > 1.
class Fit {
  public:
    Fit(size_t edge_count, std::span<const RatioSample> samples)
        : samples_(samples), ratios_(edge_count, 0.0), uses_(edge_count) {
        for (uint32_t i = 0; i < samples.size(); ++i) {
            sums_.push_back(samples[i].known);
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t edge = samples[i].edges[k];
                if (edge != kNoIndex) uses_[edge].push_back({i, samples[i].weights[k]});
            }
        }
    }

    std::vector<double> run() {
        double largest = kConverged;
        for (int sweep = 0; sweep < kMostSweeps && largest >= kConverged; ++sweep) {
            largest = 0.0;
            for (size_t edge = 0; edge < ratios_.size(); ++edge) {
                largest = std::max(largest, improve(edge));
            }
        }
        return ratios_;
    }

  private:
    /// Moves one ratio to its best value while the others stay; returns by how much.
    double improve(size_t edge) {
        double slope = kRegularization * ratios_[edge], curvature = kRegularization;
        for (const Use& use : uses_[edge]) {
            const RatioSample& sample = samples_[use.sample];
            const bool is_blocked = sample.ratio > 0.0;
            const double target = is_blocked ? sample.ratio : 1.0;
            const double error = sums_[use.sample] - target;
            if (!is_blocked && error <= 0.0) continue;
            const double scale = use.weight / (target * target);
            slope += scale * error;
            curvature += scale * use.weight;
        }
        const double next =
            std::clamp(ratios_[edge] - slope / curvature, kLeastFreeRatio, kMostFreeRatio);
        const double change = next - ratios_[edge];
        for (const Use& use : uses_[edge]) sums_[use.sample] += change * use.weight;
        ratios_[edge] = next;
        return std::abs(change);
    }

    std::span<const RatioSample> samples_;
    std::vector<double> ratios_;
    std::vector<double> sums_;  ///< L of each sample
    std::vector<std::vector<Use>> uses_;
};

}  // namespace

std::vector<double> fit_edge_ratios(size_t edge_count, std::span<const RatioSample> samples) {
    return Fit(edge_count, samples).run();
}

}  // namespace tetralight
