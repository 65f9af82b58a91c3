// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/placement/error_scale.h>
#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/placement/sights.h>
#include <tetralight/probes/no_index.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The error of the interpolated light at one position.
struct SensorError {
    uint32_t cell = kNoIndex;
    /// The square of the error, by an `ErrorScale`.
    float square = 0.0f;
    /// True also where nothing has to be.
    bool is_covered = false;

    /// The cost of a position that is not covered: more than any usual error of light.
    static constexpr double kUncovered = 10.0;

    /// What the position counts in decisions.
    [[nodiscard]] double cost() const { return double{square} + (is_covered ? 0.0 : kUncovered); }
};

/// What sensors are compared by.
struct SensorView {
    const LightPool& pool;
    Sights& sights;
    ErrorScale scale;
    /// One for each position of the pool: false where probes need not cover it, such as closer to
    /// surfaces than they may be.
    const std::vector<bool>& is_to_cover;
};

/// A volume of some positions of the pool, without sources and names. Precondition: the positions
/// differ as floats.
[[nodiscard]] ProbeVolume volume_of(const LightPool& pool, std::span<const uint32_t> probes);

/// Compares the light that a volume of `probes` interpolates at other positions of the pool
/// (`sensors`) with their baked light. As in queries, corners of the cell that a wall hides have no
/// weight, unless all are hidden.
[[nodiscard]] std::vector<SensorError> sensor_errors(const ProbeVolume& volume,
                                                     std::span<const uint32_t> probes,
                                                     std::span<const uint32_t> sensors,
                                                     const SensorView& view, uint32_t thread_count);

[[nodiscard]] double sum_of_costs(std::span<const SensorError> errors);

[[nodiscard]] size_t uncovered_count(std::span<const SensorError> errors);

/// Root mean square of the errors.
[[nodiscard]] double mean_error(std::span<const SensorError> errors);

/// The part of the errors that is noise of the sensors' light.
[[nodiscard]] double mean_noise(const LightPool& pool, std::span<const uint32_t> sensors,
                                const ErrorScale& scale);

/// The square of the noise of one of them.
[[nodiscard]] double noise_square(const LightPool& pool, uint32_t sensor, const ErrorScale& scale);

}  // namespace tetralight
