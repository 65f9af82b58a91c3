// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// What a long bake calls on its way.
struct BakeHooks {
    BakeCallback progress{};
    /// Called on the calling thread every `save_seconds` or more, when accumulators hold still.
    std::function<void()> save{};
    double save_seconds = 30.0;
};

/// Where a bake puts what its plan splits light into; empty when it splits nothing.
struct LightGroupRows {
    /// A row of `LightGroupLayout(settings.plan)` for each position: Σ directions · value over all
    /// estimates of layers and transfer, and the occlusion itself.
    std::span<double> rows = {};
    /// One for each position, when the plan has occlusion.
    std::span<const OcclusionLights> occlusion_lights = {};
};

/// Bakes world positions from where `accumulators`, one a position, stand: empty ones from the
/// start.
///
/// Probes take rounds of independent estimates until each has the error that the settings ask for.
/// (probe, estimate) is the unit of work, so that all threads are busy to the end; a probe's
/// estimates are summed in their order when the last one is there. Memory is bounded: some
/// thousand probes are in work at a time.
///
/// What a accumulator becomes is a pure function of (scene, its position, settings): the same bits
/// for any number of threads, any other positions beside, and wherever the bake stopped before; but
/// for `time_budget_seconds`. Errors: settings out of range, a position that is not finite, not
/// enough memory, "cancelled", where the accumulators hold every round that was over by then.
/// Precondition: accumulators are of the same settings, or empty; as many as positions, and as many
/// rows when the plan splits light.
[[nodiscard]] Status bake_accumulators(const Scene& scene, std::span<const glm::dvec3> positions,
                                       const BakeSettings& settings,
                                       std::span<ProbeAccumulator> accumulators,
                                       const BakeHooks& hooks = {},
                                       const LightGroupRows& light_groups = {});

}  // namespace tetralight
