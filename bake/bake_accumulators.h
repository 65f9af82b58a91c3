// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/texel_surface.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Callbacks of a running bake.
struct BakeHooks {
    BakeCallback progress{};
    /// Called on the calling thread before the first sample, if any is missing. Its error ends the
    /// bake. It counts in the time budget.
    std::function<Status()> begin{};
    /// Called on the calling thread about every `save_seconds`, while no accumulator changes, so
    /// that the accumulators can be written to a checkpoint.
    std::function<void()> save{};
    double save_seconds = 30.0;
    /// The same for a preview of the light so far. It takes at most a fiftieth of the time.
    std::function<void()> preview{};
    double preview_seconds = 5.0;
    /// Samples of all probes together between two points at which `save` and `preview` can be
    /// called.
    uint64_t samples_between_saves = 1u << 20;
    /// Called if the time budget ends the bake: the probes that are not done have so many samples.
    std::function<void(uint64_t samples)> out_of_time{};
};

/// Where a bake accumulates its light groups; empty if `LightPlan::has_light_groups` is false and
/// the plan has no occlusion of either kind.
struct LightGroupRows {
    /// One row per position, as `LightGroupLayout(settings.plan)` describes it: Σ samples · value
    /// over all estimates for layers and transfer; the value itself for both kinds of occlusion;
    /// Σ samples² · variance of the mean irradiance of a round for variances.
    std::span<double> rows = {};
    /// One element per position if the plan has occlusion, else empty.
    std::span<const OcclusionLights> occlusion_lights = {};
};

/// The probes or texels that are baked.
struct BakePlaces {
    /// World positions, by which random numbers are keyed.
    std::span<const glm::dvec3> positions;
    /// Empty for probes; for texels, one surface a position.
    TexelSurfaces surfaces{};

    [[nodiscard]] ErrorMeasure measure() const noexcept {
        return surfaces.texels.empty() ? ErrorMeasure::AllNormals : ErrorMeasure::OwnNormal;
    }
};

/// Bakes probes or texels and adds the samples to `accumulators`, one per place. An accumulator
/// that already has samples continues after its last round.
///
/// Probes get rounds of independent estimates until each reaches the target error of the settings.
/// Threads share (probe, estimate) pairs, so that all of them have work until the end; the
/// estimates of a probe are added in order when the last of them is complete. A few thousand probes
/// are in progress at a time, which bounds the memory.
///
/// The final state of an accumulator depends only on (scene, its place, settings): its bits are
/// the same for any number of threads, any other places, and any interruption in between.
/// `time_budget_seconds` decides how many rounds there are.
///
/// Returns invalid_argument if a setting is out of range, a position is not finite, or the light of
/// a place exceeds the range of float; out_of_resources if memory does not suffice; cancelled if
/// the progress callback returns false, in which case the accumulators hold all complete rounds.
///
/// Precondition: the accumulators are empty or come from the same settings. There are as many of
/// them, and as many rows if the plan has light groups, as positions. Probes have no ambient
/// occlusion.
[[nodiscard]] Status bake_accumulators(const Scene& scene, const BakePlaces& places,
                                       const BakeSettings& settings,
                                       std::span<ProbeAccumulator> accumulators,
                                       const BakeHooks& hooks = {},
                                       const LightGroupRows& light_groups = {});

}  // namespace tetralight
