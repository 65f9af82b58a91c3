// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <tetralight/bake/bake_probes.h>

namespace tetralight {

/// What the probes of a bake took, and how sure of their light they are. All 0 without probes.
struct BakeStatistics {
    uint64_t min_samples = 0;
    uint64_t median_samples = 0;
    uint64_t max_samples = 0;
    /// Probes whose standard error is known: they have light, and estimates enough.
    size_t known_error_count = 0;
    /// Relative standard errors of irradiance of those; each is one that a probe has.
    float median_error = 0.0f;
    float p99_error = 0.0f;  ///< 99 % of them have less, or the same
    float worst_error = 0.0f;
    /// Probes whose error is above the target; 0 without one.
    size_t over_target_count = 0;

    bool operator==(const BakeStatistics&) const = default;
};

/// `target_error` 0: none.
[[nodiscard]] BakeStatistics bake_statistics(const BakedProbes& baked, double target_error);

}  // namespace tetralight
