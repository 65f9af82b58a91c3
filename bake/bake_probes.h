// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bake/scene/scene.h"
#include "base/result.h"
#include "probes/sh.h"

namespace tetralight {

struct BakeSettings {
    /// Directions a probe.
    uint32_t sample_count = 1024;
    /// Reflections that light may take before it arrives; 0 = direct light only.
    uint32_t bounces = 4;
    uint64_t seed = 0;
    /// 0 = all.
    uint32_t thread_count = 0;

    bool operator==(const BakeSettings&) const = default;
};

struct BakeProgress {
    size_t probes_done = 0;
    size_t probe_count = 0;
    uint64_t ray_count = 0;
};

/// Called now and then, from any thread but never from two at once; false cancels the bake.
using BakeCallback = std::function<bool(const BakeProgress&)>;

struct BakedProbes {
    /// One a position.
    std::vector<RadianceSh> radiance;
    /// Share of directions that see a front face or the sky: 1 = free, 0 = inside something.
    std::vector<float> validity;
    /// Light of the environment alone.
    RadianceSh ambient;
    uint64_t ray_count = 0;
};

/// Bakes the light that arrives at each world position: sky, emission, the bounces of all lights,
/// and the direct light of those whose mode is `Baked`.
///
/// A pure function of (scene, positions, settings): the same bits for any number of threads and any
/// other positions beside. Errors: no samples, a position that is not finite, not enough memory,
/// "cancelled".
[[nodiscard]] Result<BakedProbes> bake_probes(const Scene& scene,
                                              std::span<const glm::dvec3> positions,
                                              const BakeSettings& settings,
                                              const BakeCallback& callback = {});

}  // namespace tetralight
