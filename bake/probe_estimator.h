// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/direction_set.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// One estimate of the light that arrives at a position, from a set of directions of its own.
/// Estimates with different keys are independent.
struct ProbeEstimate {
    RadianceSh radiance;
    uint32_t sample_count = 0;
    /// Directions that met the back of a single-sided surface first.
    uint32_t back_face_count = 0;
    uint64_t ray_count = 0;
    /// What the light is light_groups into, as a row of `LightGroupLayout`; empty when the plan
    /// splits nothing.
    std::vector<float> light_groups;
};

/// Gathers the light at `origin` (render space) over a set of directions, which is turned at
/// random: sky, emission, the bounces of all lights, and the direct light of those whose mode is
/// `Baked`. Unbiased for any set; a pure function of its arguments.
[[nodiscard]] ProbeEstimate estimate_probe(const PathTracer& tracer, glm::vec3 origin, uint64_t key,
                                           const DirectionSet& directions);

}  // namespace tetralight
