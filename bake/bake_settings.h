// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/all_bounces.h>
#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/scene/surface_color.h>

namespace tetralight {

struct BakeSettings {
    /// Samples per probe in the first round, at least 1. Without a target error, a time budget and
    /// a larger `max_sample_count` there is no second round. 128 samples or more form eight
    /// independent estimates, fewer form one estimate per 16 samples; a standard error needs at
    /// least two estimates.
    uint32_t sample_count = 1024;
    /// Relative standard error of the irradiance (`ProbeAccumulator::sampling_error`) at which a
    /// probe is done. Each round doubles the samples of the probes that are above it. 0 = no
    /// target.
    double target_error = 0.0;
    /// The same for the error of each layer of the plan (`worst_layer_error`), and of the light
    /// that is in no layer. 0 = no target.
    double target_layer_error = 0.0;
    /// Upper limit of the samples per probe over all rounds; 0 = 64 times `sample_count`. Without a
    /// target error, rounds run up to it.
    uint64_t max_sample_count = 0;
    /// No round begins that is expected to end after so many seconds; the first round always runs,
    /// and a round that has begun always ends. Without a target error, rounds run until then. 0 =
    /// no limit. It decides how many rounds there are, and nothing else: the only setting by which
    /// the result depends on the speed of the machine.
    double time_budget_seconds = 0.0;
    /// Largest radiance that the reflected light of one path may have (`PathSettings::clamp`),
    /// which trades energy for less noise. 0 = not clamped.
    float clamp = 0.0f;
    /// Maximum number of reflections of a path; 0 = direct light only. Below `kAllBounces` the
    /// light of longer paths is lost, and counts in the standard error.
    uint32_t bounces = kAllBounces;
    SurfaceSettings surfaces;
    /// Which lights are baked, and which light groups are kept apart.
    LightPlan plan;
    uint64_t seed = 0;
    /// Number of threads; 0 = all.
    uint32_t thread_count = 0;

    bool operator==(const BakeSettings&) const = default;
};

/// `target_layer_error` of `tetralight bake` by default, if layers are kept.
inline constexpr double kDefaultLayerError = 0.01;

/// The settings of `tetralight bake` when neither samples, a target error nor a time budget is
/// given: rounds up to 131 072 samples per probe, until the standard error is at most 0.5 %. If
/// layers are kept, the command also sets `kDefaultLayerError`.
[[nodiscard]] inline BakeSettings with_default_target(BakeSettings settings) {
    settings.target_error = 0.005;
    settings.max_sample_count = 131'072;
    return settings;
}

}  // namespace tetralight
