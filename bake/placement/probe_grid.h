// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/bake/placement/adaptive_grid.h>
#include <tetralight/bake/placement/coverage.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/spaces.h>
#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

// The probe-grid generator: places probes in a scene automatically.
//
//     candidates → place_probe (in or out, clearance) → reach_walls → find_spaces (flood fill,
//     light)
//                                                                          ↓
//     groups ← group_by_region ← refine_grid (adaptive) ← cover_places (inside and in sight)

namespace tetralight {

/// Where candidates are.
enum class PlacementMode : uint8_t {
    Regular,   ///< on a lattice
    Layers,    ///< at heights above every floor
    Surface,   ///< on both sides of every surface
    Adaptive,  ///< where light changes
};

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
    /// Radius of the body that the flood fill moves: spaces join where it passes, metres. Default:
    /// a tenth of the smallest spacing, at most 0.25.
    std::optional<double> agent_radius;
    /// Seeds of the flood fill: world positions in the spaces to fill. Empty: the space with most
    /// probes of those that light reaches.
    std::vector<glm::dvec3> from;
    UnreachableSpaces unreachable = UnreachableSpaces::Drop;
    DarkSpaces dark = DarkSpaces::Drop;
    /// Side of the cubes that split spaces into regions, metres; 0 = one group for each space.
    double region_size = 0.0;
    std::string name = "grid";
    /// Maximum number of candidates, or of probes in the adaptive mode. Default: 10 million
    /// (adaptive: 5 000).
    std::optional<uint64_t> max_probes;
    AdaptiveSettings adaptive;
    /// Triangles that objects move on, in world space; empty: objects move everywhere.
    std::vector<std::array<glm::dvec3, 3>> walkable;
    /// Metres above the walkable triangles up to which probes stand.
    double agent_height = 2.0;
    /// Metres between reflection probes outdoors, above 0. Without it, none are placed.
    std::optional<double> reflection_spacing;
    /// 0 = all.
    uint32_t thread_count = 0;
};

/// A place in free space that the probes leave uncovered.
struct UncoveredPlace {
    glm::dvec3 position{0.0};
    Cover cover = Cover::HullCell;

    bool operator==(const UncoveredPlace&) const = default;
};

struct ProbeGrid {
    /// One for each region, in world space; none is empty.
    std::vector<ProbeGroup> groups;
    /// Distance from each probe of the groups, in their order, to the nearest surface, metres.
    std::vector<float> surface_distances;
    uint64_t candidate_count = 0;
    /// Number of candidates with each `Fate`.
    std::array<uint64_t, kFateCount> fate_counts{};
    /// The spaces with probes or of at least a cubic metre; those with most probes first.
    std::vector<Space> spaces;
    /// Of random places in the filled spaces, a little more than the clearance off surfaces; with
    /// `PlacementMode::Layers` between the lowest and the highest of its heights.
    Coverage coverage;
    /// Those that are not covered.
    std::vector<UncoveredPlace> uncovered;
    /// The scene's adjustment volumes that do not reach into the bounds, by name.
    std::vector<std::string> adjustments_outside;
    std::optional<AdaptiveReport> adaptive;
    /// Reflection probes in the filled spaces (`place_reflections`).
    std::vector<ReflectionPlace> reflection_places;

    [[nodiscard]] uint64_t count(Fate fate) const { return fate_counts[static_cast<size_t>(fate)]; }

    [[nodiscard]] uint64_t probe_count() const { return surface_distances.size(); }
};

/// Fills a scene with probes, as its adjustment volumes allow: so that places in free space are
/// inside the tetrahedra and in sight of probes (`Cover::Covered`). Deterministic except with a
/// time budget, and the same for every order of the scene's meshes. `callback` is for the adaptive
/// mode.
///
/// Returns invalid_argument, with the setting as the field, if a spacing is not positive, the
/// bounds are empty or not finite, there is no geometry to take bounds from, there are more
/// candidates than `max_probes`, a seed is inside geometry or outside of the bounds, there is no
/// floor, or no probe is left; not_found if no node has a name of `bounds_of`; out_of_resources if
/// the candidates do not fit into memory; cancelled if the callback cancels before there is a
/// result.
[[nodiscard]] Result<ProbeGrid> make_probe_grid(const Scene& scene,
                                                const ProbeGridSettings& settings,
                                                const AdaptiveCallback& callback = {});

}  // namespace tetralight
