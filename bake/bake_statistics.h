// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <tetralight/bake/bake_probes.h>

namespace tetralight {

/// Sample counts and errors over the probes of a bake. All 0 if there are no probes.
struct BakeStatistics {
    // Samples per probe, over the probes that have samples.
    uint64_t min_samples = 0;
    uint64_t median_samples = 0;
    uint64_t max_samples = 0;
    /// Probes whose standard error is known: they receive light and have two estimates or more.
    size_t known_error_count = 0;
    // Relative standard errors of the irradiance, over the probes whose error is known.
    float median_error = 0.0f;
    float p99_error = 0.0f;  ///< 99th percentile
    float worst_error = 0.0f;
    /// Probes whose sampling error is above the target; 0 if there is no target.
    size_t over_target_count = 0;

    bool operator==(const BakeStatistics&) const = default;
};

/// `target_error`: as in `BakeSettings`; 0 = no target.
[[nodiscard]] BakeStatistics bake_statistics(const BakedProbes& baked, double target_error);

}  // namespace tetralight
