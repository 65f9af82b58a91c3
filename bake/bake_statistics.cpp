// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_statistics.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralight {
namespace {

/// The smallest value that is not exceeded by `fraction` of all.
template <class T>
T quantile(const std::vector<T>& sorted, double fraction) {
    if (sorted.empty()) return T(0);
    const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
    return sorted[std::max<size_t>(static_cast<size_t>(rank), 1) - 1];
}

template <class T>
std::vector<T> sorted(std::vector<T> values) {
    std::ranges::sort(values);
    return values;
}

}  // namespace

BakeStatistics bake_statistics(const BakedProbes& baked, double target_error) {
    auto samples = sorted(baked.sample_count);
    std::erase(samples, 0u);  // the probe was not baked: its light is from another bake
    auto errors = sorted(baked.standard_error);
    errors.erase(errors.begin(), std::ranges::upper_bound(errors, 0.0f));  // 0 = unknown
    BakeStatistics statistics;
    statistics.known_error_count = errors.size();
    statistics.min_samples = quantile(samples, 0.0);
    statistics.median_samples = quantile(samples, 0.5);
    statistics.max_samples = quantile(samples, 1.0);
    statistics.median_error = quantile(errors, 0.5);
    statistics.p99_error = quantile(errors, 0.99);
    statistics.worst_error = quantile(errors, 1.0);
    if (target_error > 0.0) {
        statistics.over_target_count = static_cast<size_t>(std::ranges::count_if(
            baked.sampling_error, [&](float error) { return error > target_error; }));
    }
    return statistics;
}

}  // namespace tetralight
