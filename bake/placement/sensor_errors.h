// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/no_index.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// What interpolation makes of the light at one position.
struct SensorError {
    uint32_t cell = kNoIndex;
    /// Mean square of the difference (`mean_square`) of the light that a query gives.
    float square = 0.0f;
    /// Of the light of those corners of the cell alone that see the position: the part that more
    /// probes in this space help against. The rest comes through walls.
    float visible_square = 0.0f;
    /// The corner (a vertex of the cell) with the largest weight that is hidden; kNoIndex: none.
    uint32_t hidden_probe = kNoIndex;
};

/// A set of probes of the pool as a volume, without sources and names. Precondition: the positions
/// differ as floats.
[[nodiscard]] ProbeVolume volume_of(const LightPool& pool, std::span<const uint32_t> probes);

/// Compares the light that a volume of some of the pool's positions gives at others with the light
/// there. With `traced` it also says what walls hide.
[[nodiscard]] std::vector<SensorError> sensor_errors(const ProbeVolume& volume,
                                                     const LightPool& pool,
                                                     std::span<const uint32_t> sensors,
                                                     const TraceScene* traced,
                                                     uint32_t thread_count);

/// Root mean square of the errors over the mean irradiance of the sensors; 0 where all is dark.
[[nodiscard]] double relative_error(std::span<const SensorError> errors, const LightPool& pool,
                                    std::span<const uint32_t> sensors);

/// The part of it that is noise of the sensors' light.
[[nodiscard]] double relative_noise(const LightPool& pool, std::span<const uint32_t> sensors);

}  // namespace tetralight
