// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bench/grid_scenes.h>
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

/// In a scene's largest free space, at random positions that the generator does not know: half of
/// them 5 cm off surfaces, distributed by area, the others uniform in the volume.
[[nodiscard]] LightReference make_reference(const GridSubject& subject, size_t count,
                                            uint32_t sample_count);

/// Error of one answer a position: root mean square over positions, 26 normals and channels,
/// relative to the mean irradiance, with the reference's noise subtracted.
[[nodiscard]] double light_error(const LightReference& reference,
                                 std::span<const IrradianceSh> answers);

/// Bakes the probes and compares queries with the reference.
[[nodiscard]] double light_error(const GridSubject& subject, const ProbeGrid& grid,
                                 const LightReference& reference, uint32_t sample_count);

/// A lattice of about `probe_count` probes.
[[nodiscard]] ProbeGrid regular_grid(const GridSubject& subject, uint64_t probe_count);

[[nodiscard]] ProbeGrid adaptive_grid(const GridSubject& subject, uint64_t probe_count);

}  // namespace tetralight::bench
