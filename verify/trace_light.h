// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/verify/plain_tracer.h>
#include <tetralight/verify/verify_report.h>

namespace tetralight {

/// How long a position is traced.
struct TraceEffort {
    /// Standard error of each channel of the mean irradiance that is aimed at, as a fraction of
    /// the channel, or of a hundredth of the brightest channel if that is more.
    double target_error = 0.01;
    /// Above 0: exactly so many paths, rounded up to batches, whatever their error.
    uint64_t sample_count = 0;
    /// Most paths of one position.
    uint64_t max_sample_count = 1 << 22;
    uint64_t seed = 0;

    bool operator==(const TraceEffort&) const = default;
};

/// Paths of the first look at a position, from which their number follows.
inline constexpr uint64_t kPilotSampleCount = 16 * PlainTracer::kBatchSize;

/// Mean light at a world position, with its standard error from the spread of independent batches.
/// A first look estimates how many paths the target needs, and is then dropped: if the same paths
/// decided when to end, those that end early by chance would be too dark. A pure function of scene,
/// settings, position and effort.
[[nodiscard]] TracedLight trace_light(const PlainTracer& tracer, const glm::dvec3& position,
                                      const TraceEffort& effort);

}  // namespace tetralight
