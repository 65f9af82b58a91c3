// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/cut_light.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/direction_set.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// One estimate of the light that arrives at a position. Estimates with different keys are
/// independent.
struct ProbeEstimate {
    RadianceSh radiance;
    /// Paths traced, one per direction of the set.
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

}  // namespace tetralight
