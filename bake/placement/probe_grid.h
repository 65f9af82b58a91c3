// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "bake/scene/scene.h"
#include "bake/scene/scene_bounds.h"
#include "base/result.h"
#include "probes/probe_group.h"

namespace tetralight {

struct ProbeGridSettings {
    /// Metres between probes on each axis.
    glm::dvec3 spacing{1.0};
    /// What to fill; none = the bounds of what contributes global illumination.
    std::optional<Box> bounds;
    std::string group_name = "grid";
    uint64_t max_probe_count = 10'000'000;
    /// 0 = all.
    uint32_t thread_count = 0;
};

struct ProbeGrid {
    ProbeGroup group;
    uint64_t candidate_count = 0;
    /// Candidates that were dropped because they lie inside geometry.
    uint64_t inside_count = 0;
};

/// A lattice of probes in the middle of the bounds, half a spacing or more from their sides,
/// without the probes that lie inside geometry. Each axis has two layers at least; where the bounds
/// are thinner they stand on the lower end of Y and around the middle of X and Z.
///
/// Errors: spacing that is not positive, bounds that are empty or not finite, nothing to take
/// bounds from, more candidates than `max_probe_count` (the message says how many), no probe left.
[[nodiscard]] Result<ProbeGrid> make_probe_grid(const Scene& scene,
                                                const ProbeGridSettings& settings);

}  // namespace tetralight
