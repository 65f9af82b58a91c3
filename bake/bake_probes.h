// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

struct BakedProbes {
    // One a position.
    std::vector<RadianceSh> radiance;
    /// Share of directions that see a front face or the sky: 1 = free, 0 = inside something.
    std::vector<float> validity;
    /// Of irradiance, as a share of it (`ProbeAccumulator::standard_error`).
    std::vector<float> standard_error;
    /// Directions taken.
    std::vector<uint64_t> sample_count;

    /// Light of the environment alone.
    RadianceSh ambient;
    uint64_t ray_count = 0;
};

/// Bakes the light that arrives at each world position: sky, emission, the bounces of all lights,
/// and the direct light of those whose mode is `Baked`. The same as `bake_accumulators`, from the
/// start to the end.
///
/// Precondition: the plan of the settings splits no light. A pure function of (scene, positions,
/// settings), time budgets aside: the same bits for any
/// number of threads and any other positions beside. Errors: settings out of range, a position that
/// is not finite, not enough memory, "cancelled".
[[nodiscard]] Result<BakedProbes> bake_probes(const Scene& scene,
                                              std::span<const glm::dvec3> positions,
                                              const BakeSettings& settings,
                                              const BakeCallback& callback = {});

/// What accumulators amount to; `ambient` is left black.
[[nodiscard]] BakedProbes make_baked_probes(std::span<const ProbeAccumulator> accumulators);

}  // namespace tetralight
