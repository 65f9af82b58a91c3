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

// The probe-grid generator: places probes in a scene automatically.
//
//     candidates → place_probe (in or out, clearance) → FreeSpaceMap (flood fill) ┬→
//     group_by_region → groups
//                                                                       └→ refine_grid ─┘

namespace tetralight {

/// Where candidates are.
enum class PlacementMode : uint8_t {
    Regular,   ///< on a lattice
    Layers,    ///< at heights above every floor
    Surface,   ///< on both sides of every surface
    Adaptive,  ///< where light changes
};

/// What happens to probes in spaces that are not to be filled.
enum class UnreachableSpaces : bool { Drop, Keep };

struct ProbeGridSettings {
    PlacementMode mode = PlacementMode::Regular;
    /// Metres between probes on each axis; the adaptive mode uses `adaptive.start_spacing`.
    glm::dvec3 spacing{1.0};
    /// The box to fill: no probe is outside of it. Default: the bounds of the instances that
    /// contribute global illumination, padded (`padded_bounds`).
    std::optional<WorldBox> bounds;
    /// Names of nodes to take the bounds of instead, with all nodes below them.
    std::vector<std::string> bounds_of;
    /// Layers: metres above the floor. A height that is closer than the clearance to an earlier one
    /// is ignored.
    std::vector<double> heights{0.3, 1.7};
    /// Minimum distance of probes to surfaces, metres. Default: a tenth of the smallest spacing, at
    /// most 0.25 (adaptive: 0.05).
    std::optional<double> clearance;
    /// Seeds of the flood fill: world positions in the spaces to fill. Empty: the space with most
    /// probes.
    std::vector<glm::dvec3> from;
    UnreachableSpaces unreachable = UnreachableSpaces::Drop;
    /// Side of the cubes that split spaces into regions, metres; 0 = one group for each space.
    double region_size = 0.0;
    std::string name = "grid";
    /// Maximum number of candidates, or of probes in the adaptive mode. Default: 10 million
    /// (adaptive: 5 000).
    std::optional<uint64_t> max_probes;
    AdaptiveSettings adaptive;
    /// 0 = all.
    uint32_t thread_count = 0;
};

/// A space whose probes were dropped.
struct DroppedSpace {
    uint64_t probe_count = 0;
    /// One of its probes: a seed that would keep it.
    glm::dvec3 position{0.0};

    bool operator==(const DroppedSpace&) const = default;
};

/// A space without probes.
struct EmptySpace {
    /// A free position in it.
    glm::dvec3 position{0.0};
    /// True if it is one of the spaces to fill.
    bool is_wanted = false;

    bool operator==(const EmptySpace&) const = default;
};

struct ProbeGrid {
    /// One for each region, in world space; none is empty.
    std::vector<ProbeGroup> groups;
    /// Distance from each probe of the groups, in their order, to the nearest surface, metres.
    std::vector<float> surface_distances;
    uint64_t candidate_count = 0;
    /// Number of candidates with each `Fate`.
    std::array<uint64_t, kFateCount> fate_counts{};
    /// The spaces that were dropped, the largest first.
    std::vector<DroppedSpace> dropped_spaces;
    /// Spaces of at least about a cubic metre without a candidate.
    std::vector<EmptySpace> empty_spaces;
    /// The scene's adjustment volumes that do not reach into the bounds, by name.
    std::vector<std::string> adjustments_outside;
    std::optional<AdaptiveReport> adaptive;

    [[nodiscard]] uint64_t count(Fate fate) const { return fate_counts[static_cast<size_t>(fate)]; }

    [[nodiscard]] uint64_t probe_count() const { return surface_distances.size(); }
};

/// Fills a scene with probes, as its adjustment volumes allow. Deterministic except with a time
/// budget, and the same for every order of the scene's meshes. `callback` is for the adaptive mode.
///
/// Returns invalid_argument, with the setting as the field, if the spacing is not positive, the
/// bounds are empty or not finite, there is no geometry to take bounds from, there are more
/// candidates than `max_probes`, a seed is inside geometry or outside of the bounds, there is no
/// floor, or no probe is left; not_found if no node has a name of `bounds_of`; out_of_resources if
/// the candidates do not fit into memory; cancelled if the callback cancels before there is a
/// result.
[[nodiscard]] Result<ProbeGrid> make_probe_grid(const Scene& scene,
                                                const ProbeGridSettings& settings,
                                                const AdaptiveCallback& callback = {});

}  // namespace tetralight
