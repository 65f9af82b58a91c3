// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// What became of a candidate for a probe.
enum class Fate : uint8_t {
    Kept,
    Pushed,       ///< kept, out of geometry or away from a surface
    Inside,       ///< inside geometry, and no way out in reach
    TooClose,     ///< nearer to a surface than the clearance, and no better place in reach
    Unreachable,  ///< in a space that is not asked for
    Forbidden,    ///< in an adjustment volume that forbids probes
    Crowded,      ///< beside another probe
    Redundant,    ///< light is as good without it
};

inline constexpr int kFateCount = 8;

[[nodiscard]] inline bool is_kept(Fate fate) {
    return fate == Fate::Kept || fate == Fate::Pushed;
}

/// Where probes may stand.
struct ClearanceRule {
    /// Metres from every surface; 0 = only not inside.
    double clearance = 0.0;
    /// A candidate that has to move moves this far at most, metres.
    double max_push = 0.0;
    /// It moves to nowhere else.
    WorldBox bounds{glm::dvec3(-std::numeric_limits<double>::infinity()),
                    glm::dvec3(std::numeric_limits<double>::infinity())};
};

/// A candidate, and where it stands in the end.
struct PlacedProbe {
    glm::dvec3 position{0.0};
    Fate fate = Fate::Kept;
    /// Metres to the nearest surface; infinite: there is none.
    float surface_distance = 0.0f;

    bool operator==(const PlacedProbe&) const = default;
};

/// Keeps a candidate where it stands, moves it out of geometry and away from surfaces, or says why
/// it cannot be kept. A move leads through no surface but the one that the candidate is behind of:
/// the shortest way along one of the axes, which leaves it in the planes of its lattice, or else
/// away from the nearest surface. Pure.
[[nodiscard]] PlacedProbe place_probe(const TraceScene& traced, const glm::dvec3& candidate,
                                      const ClearanceRule& rule);

/// How a position lies to the geometry around it.
enum class PointClass : uint8_t {
    Free,
    Uncertain,  ///< taken for free, but nothing is moved there
    Inside,
};

/// How a position in render space stands: by the shares of back faces around it
/// (`ProbeVisibility::is_inside`), and where there are few of them by counting, in some directions,
/// all surfaces out to the sky: among solids that cross each other the nearest surfaces may all be
/// fronts of others.
[[nodiscard]] PointClass classify_point(const TraceScene& traced, glm::vec3 position,
                                        const ProbeVisibility& around);

/// Whether a world position is free beyond doubt and `clearance` metres from all surfaces.
[[nodiscard]] bool is_free_with_clearance(const TraceScene& traced, const glm::dvec3& position,
                                          double clearance);

/// Whether nothing stands between two positions in render space.
[[nodiscard]] bool is_visible(const TraceScene& traced, glm::vec3 from, glm::vec3 to);

}  // namespace tetralight
