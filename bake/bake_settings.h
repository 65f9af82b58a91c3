// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/scene/surface_color.h>

namespace tetralight {

struct BakeSettings {
    /// Directions a probe in the first round, and without a target the only one. 128 and more are
    /// eight independent estimates, fewer are one for each 16, with error bars from two on.
    uint32_t sample_count = 1024;
    /// Relative standard error of irradiance (`ProbeAccumulator::standard_error`) below which a
    /// probe is done: rounds double what it has until it is there. 0 = one round.
    double target_error = 0.0;
    /// Directions a probe at most when there are rounds; 0 = 64 times `sample_count`.
    uint64_t max_sample_count = 0;
    /// After this many seconds no round goes on; the first one always ends. Without a target,
    /// rounds go on until then. 0 = none. The only setting whose result is not reproducible.
    double time_budget_seconds = 0.0;
    /// Largest radiance that a path may bring, for less noise and less light; 0 = not clamped.
    float clamp = 0.0f;
    /// Reflections that light may take before it arrives; 0 = direct light only.
    uint32_t bounces = 4;
    SurfaceSettings surfaces;
    /// What is baked of each light, and what light is split into.
    LightPlan plan;
    uint64_t seed = 0;
    /// 0 = all.
    uint32_t thread_count = 0;

    bool operator==(const BakeSettings&) const = default;
};

/// What `tetralight bake` does when it is told neither samples nor an error nor a time: as many
/// samples as each probe needs, within bounds.
[[nodiscard]] inline BakeSettings with_default_target(BakeSettings settings) {
    settings.target_error = 0.005;
    settings.max_sample_count = 131'072;
    return settings;
}

}  // namespace tetralight
