// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "bake/bake_progress.h"
#include "bake/bake_settings.h"
#include "bake/probe_tally.h"
#include "bake/scene/scene.h"
#include "base/result.h"
#include "probes/probe_volume.h"

namespace tetralight {

/// What a long bake calls on its way.
struct BakeHooks {
    BakeCallback progress{};
    /// Called on the calling thread every `save_seconds` or more, when tallies hold still.
    std::function<void()> save{};
    double save_seconds = 30.0;
};

/// Where a bake puts what its plan splits light into; empty when it splits nothing.
struct SplitRows {
    /// A row of `SplitLayout(settings.plan)` for each position: Σ directions · value over all
    /// estimates of layers and transfer, and the occlusion itself.
    std::span<double> rows = {};
    /// One for each position, when the plan has occlusion.
    std::span<const OcclusionLights> occlusion_lights = {};
};

/// Bakes world positions from where `tallies`, one a position, stand: empty ones from the start.
///
/// Probes take rounds of independent estimates until each has the error that the settings ask for.
/// (probe, estimate) is the unit of work, so that all threads are busy to the end; a probe's
/// estimates are summed in their order when the last one is there. Memory is bounded: some
/// thousand probes are in work at a time.
///
/// What a tally becomes is a pure function of (scene, its position, settings): the same bits for
/// any number of threads, any other positions beside, and wherever the bake stopped before; but
/// for `time_budget_seconds`. Errors: settings out of range, a position that is not finite, not
/// enough memory, "cancelled", where the tallies hold every round that was over by then.
/// Precondition: tallies are of the same settings, or empty; as many as positions, and as many
/// rows when the plan splits light.
[[nodiscard]] Status bake_tallies(const Scene& scene, std::span<const glm::dvec3> positions,
                                  const BakeSettings& settings, std::span<ProbeTally> tallies,
                                  const BakeHooks& hooks = {}, const SplitRows& split = {});

}  // namespace tetralight
