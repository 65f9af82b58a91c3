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

/// The error of the interpolated light at one position.
struct SensorError {
    uint32_t cell = kNoIndex;
    /// Mean square (`mean_square`) of the difference between the interpolated and the baked light.
    float square = 0.0f;
    /// The same for light that is interpolated only from corners of the cell that are visible from
    /// the position: more probes in this space reduce it. The other part of `square` is light that
    /// leaks through walls.
    float visible_square = 0.0f;
    /// The hidden corner (a vertex of the cell) with the largest weight; kNoIndex if none is
    /// hidden.
    uint32_t hidden_probe = kNoIndex;
};

/// A volume of some positions of the pool, without sources and names. Precondition: the positions
/// differ as floats.
[[nodiscard]] ProbeVolume volume_of(const LightPool& pool, std::span<const uint32_t> probes);

/// Compares the light that a volume interpolates at positions of the pool (`sensors`) with their
/// baked light. With `traced` it also finds hidden corners.
[[nodiscard]] std::vector<SensorError> sensor_errors(const ProbeVolume& volume,
                                                     const LightPool& pool,
                                                     std::span<const uint32_t> sensors,
                                                     const TraceScene* traced,
                                                     uint32_t thread_count);

/// Root mean square of the errors over the mean irradiance of the sensors; 0 if all is dark.
[[nodiscard]] double relative_error(std::span<const SensorError> errors, const LightPool& pool,
                                    std::span<const uint32_t> sensors);

/// The part of `relative_error` that is noise of the sensors' light.
[[nodiscard]] double relative_noise(const LightPool& pool, std::span<const uint32_t> sensors);

}  // namespace tetralight
