// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/placement/space_light.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// What happens to probes in spaces that are not to be filled.
enum class UnreachableSpaces : bool { Drop, Keep };

/// What happens to probes in spaces that no light reaches.
enum class DarkSpaces : bool { Drop, Keep };

enum class SpaceFate : uint8_t {
    Filled,
    Unreachable,  ///< none of the spaces to fill
    Dark,         ///< no light reaches it
};

/// A connected part of the free space in the bounds.
struct Space {
    /// A free position in it: a seed that asks for this space.
    glm::dvec3 position{0.0};
    /// Where the center of a body may be, m³.
    double volume = 0.0;
    /// Probes in it, or of a space that is not filled the candidates that would have been kept.
    uint64_t probe_count = 0;
    SpaceLight light;
    bool has_seed = false;
    SpaceFate fate = SpaceFate::Filled;

    bool operator==(const Space&) const = default;
};

/// Which spaces to fill.
struct SpaceRule {
    WorldBox bounds;
    double clearance = 0.0;
    /// World positions in the spaces to fill; empty: the one with most probes that light reaches.
    std::span<const glm::dvec3> seeds;
    UnreachableSpaces unreachable = UnreachableSpaces::Drop;
    /// Spaces with a seed are kept even if they are dark, and so are all if no light reaches any.
    /// Keep: dark ones are filled beside the one that is chosen, unless there are seeds.
    DarkSpaces dark = DarkSpaces::Drop;
    uint32_t thread_count = 0;
};

/// A space as the map knows it.
struct MappedSpace {
    uint32_t number = 0;  ///< in the map
    Space space;
    /// Free positions with clearance that are spread over it; at most 64.
    std::vector<glm::dvec3> places;
};

/// The spaces that have probes, a seed, or at least a cubic metre and a free position with
/// clearance; those with most probes first. Joins the spaces in the map that a probe or a seed
/// connects, and sets the fate of probes in spaces that are not filled. Returns invalid_argument,
/// with the field `from`, if a seed is inside geometry, outside of the bounds, or in a gap that is
/// too narrow for the map; errors of `bake_accumulators`.
[[nodiscard]] Result<std::vector<MappedSpace>> find_spaces(const Scene& scene,
                                                           const TraceScene& traced,
                                                           FreeSpaceMap& map, const SpaceRule& rule,
                                                           std::vector<PlacedProbe>& probes);

}  // namespace tetralight
