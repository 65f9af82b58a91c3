// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/placement/error_scale.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

namespace tetralight {

struct AdaptiveSettings {
    /// Spacing of the start lattice, metres. Default: an eighth of the longest side.
    std::optional<glm::dvec3> start_spacing;
    /// Refinement ends at this error of the interpolated light: root mean square over positions,
    /// normals and channels, as a fraction of the irradiance that `error_kind` says.
    double target_error = 0.05;
    ErrorKind error_kind = ErrorKind::Mixed;
    /// Refinement ends after this time, seconds; 0 = no limit. The result is not reproducible.
    double time_budget_seconds = 0.0;
    /// Settings of the light: bounces, surfaces, clamp, seed. Sample counts are ignored: the
    /// sensors determine them.
    BakeSettings bake;
};

/// Progress of the refinement.
struct AdaptiveProgress {
    uint32_t round = 0;
    size_t probe_count = 0;
    /// Error with the current probes.
    double error = 0.0;
    bool is_removing = false;
};

/// Called after each round and from time to time within one. Returns false to cancel.
using AdaptiveCallback = std::function<bool(const AdaptiveProgress&)>;

/// Why the refinement ended.
enum class AdaptiveEnd : uint8_t {
    TargetReached,
    MaxProbes,
    TimeOver,
    Interrupted,
    NothingToRefine,  ///< no position that costs anything may have a probe
};

/// The name in reports: "target reached"...
[[nodiscard]] const char* name_of(AdaptiveEnd end);

struct AdaptiveReport {
    /// Error at sensors that are not used for decisions, with their noise subtracted.
    double error = 0.0;
    AdaptiveEnd end = AdaptiveEnd::TargetReached;
    uint32_t round_count = 0;
    /// Spacing of the start lattice, metres.
    glm::dvec3 start_spacing{0.0};
    /// Probes at the start, and the largest number before removal.
    uint64_t start_probe_count = 0;
    uint64_t peak_probe_count = 0;
    /// Positions whose light was baked, samples of all of them, and rays.
    uint64_t position_count = 0;
    uint64_t sample_count = 0;
    uint64_t ray_count = 0;
};

/// The scene and the rules of the refinement.
struct AdaptiveInput {
    const Scene& scene;
    const TraceScene& traced;
    WorldBox bounds;
    double clearance = 0.0;
    /// Least distance to surfaces of places that probes have to cover, metres.
    double place_clearance = 0.0;
    /// Returns true if a free position may have a probe.
    std::function<bool(const glm::dvec3& position)> is_allowed;
    /// Returns the space of a position. Each space keeps probes that span what its start spans.
    std::function<uint32_t(const glm::dvec3& position)> space_of;
    /// Positions with clearance for additional sensors, in small spaces that evenly distributed
    /// ones miss.
    std::vector<glm::dvec3> sensors;
    uint64_t max_probes = 0;
    uint32_t thread_count = 0;
};

/// Places probes where the light changes. Starts with the kept ones of `probes`, refines the cells
/// whose places are not covered or whose interpolated light is wrong, round by round, then removes
/// the probes with the least effect, and moves the least useful ones while that helps. Updates the
/// fates in `probes` and appends new probes. Probes with `is_protected` (one flag for each of
/// `probes`, or none at all) are not removed. Deterministic without a time budget.
///
/// If the callback cancels or the time is over, the result is that of the last round. Returns
/// cancelled, or invalid_argument with the field `time_budget`, if there is no round yet, and
/// invalid_argument if there is no free position to measure light at.
[[nodiscard]] Result<AdaptiveReport> refine_grid(const AdaptiveInput& input,
                                                 const AdaptiveSettings& settings,
                                                 std::vector<PlacedProbe>& probes,
                                                 const std::vector<bool>& is_protected,
                                                 const AdaptiveCallback& callback);

}  // namespace tetralight
