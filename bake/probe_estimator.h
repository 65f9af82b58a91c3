// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/cut_light.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/direction_set.h>
#include <tetralight/bake/texel_surface.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// One estimate of the light that arrives at a probe or a texel. Estimates with different keys are
/// independent.
struct ProbeEstimate {
    RadianceSh radiance;
    /// Paths traced.
    uint32_t sample_count = 0;
    /// Samples whose first hit is the back face of a single-sided surface.
    uint32_t back_face_count = 0;
    uint64_t ray_count = 0;
    /// What is known of the light of longer paths than the tracer's limit of bounces.
    CutLight cut;
    /// Layers and transfer as the begin of a row of `LightGroupLayout`; empty if the plan has none.
    /// `bake_accumulators` appends the occlusion.
    std::vector<float> light_groups;
};

/// Estimates the light at `origin` (render space) with one path per direction of a set that is
/// rotated at random: sky, emission, the bounces of all lights, and the direct light of those whose
/// mode is `Baked`. Unbiased for any set. A pure function.
[[nodiscard]] ProbeEstimate estimate_probe(const PathTracer& tracer, glm::vec3 origin, uint64_t key,
                                           const DirectionSet& directions);

/// Estimates the light that arrives at a texel at `position` (render space), from the hemisphere of
/// its normal, with `sample_count` paths that start at its origins in turn. The coefficients are in
/// the frame `frame_around(normal)`, in which the normal is +Z: they are those of the radiance that
/// is 0 below the surface. Includes the light that `estimate_probe` does. Unbiased; a pure
/// function.
[[nodiscard]] ProbeEstimate estimate_texel(const PathTracer& tracer, glm::vec3 position,
                                           const TexelSurface& surface, uint64_t key,
                                           uint32_t sample_count);

}  // namespace tetralight
