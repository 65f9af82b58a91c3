// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

namespace tetralight {

struct AdaptiveSettings {
    /// Metres between the probes that it begins with; none = an eighth of the longest side.
    std::optional<glm::dvec3> start_spacing;
    /// Done when light interpolated from the probes is this near to the light that is there: root
    /// mean square over positions, normals and channels, as a share of the mean irradiance.
    double target_error = 0.05;
    /// Seconds after which nothing is refined any more; 0 = none. Not reproducible.
    double time_budget_seconds = 0.0;
    /// Of it the light: bounces, surfaces, clamp, seed. How many samples it takes is found out.
    BakeSettings bake;
};

/// How far it is.
struct AdaptiveProgress {
    uint32_t round = 0;
    size_t probe_count = 0;
    /// Of the probes that there are.
    double error = 0.0;
    bool is_removing = false;
};

/// Called after each round and now and then in between; false ends it.
using AdaptiveCallback = std::function<bool(const AdaptiveProgress&)>;

/// Why it ended.
enum class AdaptiveEnd : uint8_t {
    TargetReached,
    MaxProbes,
    TimeOver,
    Interrupted,
    NothingToRefine,  ///< all errors are noise, or no better place is free
};

/// "target reached" and so on.
[[nodiscard]] const char* name_of(AdaptiveEnd end);

struct AdaptiveReport {
    /// At positions that had no say in where probes went, without the noise of their own light.
    double error = 0.0;
    AdaptiveEnd end = AdaptiveEnd::TargetReached;
    uint32_t round_count = 0;
    /// Metres between the lattice's probes that it began with.
    glm::dvec3 start_spacing{0.0};
    /// Probes at the start, and before those were removed that do little.
    uint64_t start_probe_count = 0;
    uint64_t peak_probe_count = 0;
    /// Positions whose light was baked, the directions of each, and rays.
    uint64_t position_count = 0;
    uint32_t sample_count = 0;
    uint64_t ray_count = 0;
};

/// Where it works.
struct AdaptiveInput {
    const Scene& scene;
    const TraceScene& traced;
    WorldBox bounds;
    double clearance = 0.0;
    /// Whether a probe may stand at a position that is free.
    std::function<bool(const glm::dvec3& position)> is_allowed;
    /// The space that a position lies in: each keeps probes that span what its start spans.
    std::function<uint32_t(const glm::dvec3& position)> space_of;
    /// Where light is measured beside places that are spread evenly: in small spaces.
    std::vector<glm::dvec3> sensors;
    uint64_t max_probes = 0;
    uint32_t thread_count = 0;
};

/// Puts probes where light changes: from the `start`, of which those that are not kept stay as they
/// are, it refines cells whose interpolated light is wrong, round by round, and then removes the
/// probes that do least. Returns the start with the fates that it has now, and new probes behind
/// it. Probes flagged `is_protected` (one a start) stay. Deterministic without a time budget.
///
/// When it is interrupted or out of time, the result is that of the last round; the error
/// "interrupted" (or "out of time ...") says that there was none yet. Further errors: no place to
/// measure light at, and spaces that need more probes than there may be.
[[nodiscard]] Result<AdaptiveReport> refine_grid(const AdaptiveInput& input,
                                                 const AdaptiveSettings& settings,
                                                 std::vector<PlacedProbe>& probes,
                                                 const std::vector<bool>& is_protected,
                                                 const AdaptiveCallback& callback);

}  // namespace tetralight
