// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/sh.h>

namespace tetralight::bench {

/// Path-traced light at positions.
struct LightReference {
    std::vector<glm::vec3> positions;
    std::vector<IrradianceSh> light;
    /// Root mean square of its noise, relative to the mean irradiance.
    double noise = 0.0;
};

[[nodiscard]] LightReference bake_reference(const Scene& scene,
                                            std::span<const glm::dvec3> positions,
                                            uint32_t sample_count);

/// At `count` places, about, of `ReachablePlaces` that light reaches.
[[nodiscard]] LightReference make_reference(const GridSubject& subject, size_t count,
                                            uint32_t sample_count);

/// How answers differ from a reference. The error of a place is the root mean square over 26
/// normals and channels. All but the last are relative to the mean irradiance of all places.
struct LightErrors {
    double rms = 0.0;  ///< root mean square over places, with the reference's noise subtracted
    double mean = 0.0;
    double p95 = 0.0;  ///< 95 % of the places have a smaller error
    /// Median over places of the error divided by the root mean square of the place's own light.
    double relative = 0.0;
};

/// The errors of one answer a position.
[[nodiscard]] LightErrors light_errors(const LightReference& reference,
                                       std::span<const IrradianceSh> answers);

/// Those of queries, by weights that know walls.
[[nodiscard]] LightErrors light_errors(const ProbeVolumeView& volume,
                                       const LightReference& reference);

/// `LightErrors::rms` of one answer a position.
[[nodiscard]] double light_error(const LightReference& reference,
                                 std::span<const IrradianceSh> answers);

[[nodiscard]] BakedVolume bake_grid(const GridSubject& subject, const ProbeGrid& grid,
                                    uint32_t sample_count);

/// A lattice with a spacing in metres.
[[nodiscard]] ProbeGrid spaced_grid(const GridSubject& subject, double spacing);

/// A lattice of about `probe_count` probes.
[[nodiscard]] ProbeGrid regular_grid(const GridSubject& subject, uint64_t probe_count);

[[nodiscard]] ProbeGrid adaptive_grid(const GridSubject& subject, uint64_t probe_count);

}  // namespace tetralight::bench
