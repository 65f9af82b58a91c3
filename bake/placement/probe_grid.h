// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/bake/placement/adaptive_grid.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

// The probe-grid generator: probes for a scene that nobody has to place by hand.
//
//     candidates → place_probe (in or out, clearance) → FreeSpaceMap (flood fill) ┬→
//     group_by_region → groups
//                                                                       └→ refine_grid ─┘

namespace tetralight {

/// Where candidates stand.
enum class PlacementMode : uint8_t {
    Regular,   ///< on a lattice
    Layers,    ///< at heights above every floor
    Surface,   ///< on both sides of every surface
    Adaptive,  ///< where light changes
};

/// What becomes of spaces without a seed.
enum class UnreachableSpaces : bool { Drop, Keep };

struct ProbeGridSettings {
    PlacementMode mode = PlacementMode::Regular;
    /// Metres between probes on each axis; `adaptive` has its own.
    glm::dvec3 spacing{1.0};
    /// What to fill: no probe stands outside of it. None = the bounds of what contributes global
    /// illumination, with some room around (`padded_bounds`).
    std::optional<WorldBox> bounds;
    /// Nodes whose bounds, with all below them, to fill instead, by name.
    std::vector<std::string> bounds_of;
    /// Layers: metres above the floor. Of those nearer to each other than the clearance the first
    /// counts.
    std::vector<double> heights{0.3, 1.7};
    /// Metres that probes keep from surfaces; none = a tenth of the smallest spacing, 0.25 at most
    /// (0.05 when adaptive).
    std::optional<double> clearance;
    /// World positions in the spaces to fill; none = the space that most probes are in.
    std::vector<glm::dvec3> from;
    UnreachableSpaces unreachable = UnreachableSpaces::Drop;
    /// Metres along the side of the cubes that groups are split by; 0 = one group for each space.
    double region_size = 0.0;
    std::string name = "grid";
    /// More candidates are refused; the adaptive mode puts so many probes at most. None = 10
    /// million, or 5 000 when adaptive.
    std::optional<uint64_t> max_probes;
    AdaptiveSettings adaptive;
    /// 0 = all.
    uint32_t thread_count = 0;
};

/// A space that no seed lies in.
struct DroppedSpace {
    uint64_t probe_count = 0;
    /// One of its probes: a seed that would keep it.
    glm::dvec3 position{0.0};

    bool operator==(const DroppedSpace&) const = default;
};

/// A space that nothing stands in.
struct EmptySpace {
    /// Where a probe could stand.
    glm::dvec3 position{0.0};
    /// It was asked for.
    bool is_wanted = false;

    bool operator==(const EmptySpace&) const = default;
};

struct ProbeGrid {
    /// Of one region each, in world space; none is empty.
    std::vector<ProbeGroup> groups;
    /// Metres from each probe of the groups, in their order, to the nearest surface.
    std::vector<float> surface_distances;
    uint64_t candidate_count = 0;
    /// How many candidates had which `Fate`.
    std::array<uint64_t, kFateCount> fate_counts{};
    /// The spaces that were dropped, the largest first.
    std::vector<DroppedSpace> dropped_spaces;
    /// Spaces of a cubic metre or so that no candidate stands in.
    std::vector<EmptySpace> empty_spaces;
    /// The scene's adjustment volumes that do not reach into the bounds, by name.
    std::vector<std::string> adjustments_outside;
    std::optional<AdaptiveReport> adaptive;

    [[nodiscard]] uint64_t count(Fate fate) const { return fate_counts[static_cast<size_t>(fate)]; }

    [[nodiscard]] uint64_t probe_count() const { return surface_distances.size(); }
};

/// Fills a scene with probes, as its adjustment volumes allow. Deterministic (time budgets aside),
/// and the same for every order of the scene's meshes. `callback` is for the adaptive mode.
///
/// Errors: spacing that is not positive, bounds that are empty or not finite, nothing to take
/// bounds from, a node that is not there, more candidates than `max_probes` or memory allows
/// (the message says how many), a seed inside geometry or out of bounds, no floor, no probe left.
[[nodiscard]] Result<ProbeGrid> make_probe_grid(const Scene& scene,
                                                const ProbeGridSettings& settings,
                                                const AdaptiveCallback& callback = {});

}  // namespace tetralight
