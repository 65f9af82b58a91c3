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

/// The result of a bake: one element per position in each vector.
struct BakedProbes {
    /// Radiance that arrives at the probe, as SH coefficients.
    std::vector<RadianceSh> radiance;
    /// Fraction of samples that hit a front face or the sky: 1 = in free space, 0 = inside
    /// geometry.
    std::vector<float> validity;
    /// Relative standard error of the irradiance (`ProbeAccumulator::standard_error`).
    std::vector<float> standard_error;
    /// The part of it that more samples reduce (`ProbeAccumulator::sampling_error`).
    std::vector<float> sampling_error;
    /// Samples taken.
    std::vector<uint64_t> sample_count;

    /// Radiance of the environment alone.
    RadianceSh ambient;
    uint64_t ray_count = 0;
};

/// Bakes the light that arrives at each world position: sky, emission, the bounces of all lights,
/// and the direct light of those whose mode is `Baked`. Calls `bake_accumulators` with empty
/// accumulators.
///
/// A pure function of (scene, positions, settings): the same bits for any number of threads, and
/// for each position whatever the other positions are. Only a time budget breaks this.
///
/// Returns the errors of `bake_accumulators`. Precondition: the plan of the settings has neither
/// light groups nor occlusion.
[[nodiscard]] Result<BakedProbes> bake_probes(const Scene& scene,
                                              std::span<const glm::dvec3> positions,
                                              const BakeSettings& settings,
                                              const BakeCallback& callback = {});

/// The result that accumulators stand for. `ambient` is left black.
[[nodiscard]] BakedProbes make_baked_probes(std::span<const ProbeAccumulator> accumulators);

}  // namespace tetralight
