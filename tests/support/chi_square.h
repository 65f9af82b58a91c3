// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>

namespace tetralight::test {

/// Σ (observed − expected)² / expected. Its mean is k = bins − 1 and its variance 2k, so that
/// k + 4 √(2k) is passed once in about ten thousand trials; a test is one fixed trial.
inline double chi_square(std::span<const int> observed, double expected) {
    double sum = 0.0;
    for (const int count : observed) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

inline double chi_square_limit(size_t bins) {
    const auto k = static_cast<double>(bins - 1);
    return k + 4.0 * std::sqrt(2.0 * k);
}

/// The same for bins of different expectations. Bins that expect less than five are counted as one.
inline bool has_frequencies(std::span<const int> observed, std::span<const double> expected) {
    double sum = 0.0, rare_observed = 0.0, rare_expected = 0.0;
    size_t bins = 1;
    const auto add = [&sum](double count, double mean) {
        sum += (count - mean) * (count - mean) / mean;
    };
    for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 5.0) {
            rare_observed += observed[i];
            rare_expected += expected[i];
        } else {
            add(observed[i], expected[i]);
            ++bins;
        }
    }
    if (rare_expected == 0.0 && rare_observed > 0.0) return false;
    if (rare_expected > 0.0) add(rare_observed, rare_expected);
    return sum < chi_square_limit(bins);
}

/// Bins of directions: 8 of y times 16 of azimuth, all of one solid angle.
inline constexpr size_t kDirectionBins = 128;

inline size_t direction_bin(glm::vec3 d) {
    const double turn = std::atan2(d.z, d.x) / (2.0 * std::numbers::pi) + 0.5;
    const auto column = std::min<size_t>(15, static_cast<size_t>(turn * 16.0));
    return std::min<size_t>(7, static_cast<size_t>((d.y + 1.0) * 4.0)) * 16 + column;
}

}  // namespace tetralight::test
