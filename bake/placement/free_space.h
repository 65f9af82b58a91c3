// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// The result for a candidate.
enum class Fate : uint8_t {
    Kept,
    Pushed,       ///< kept, out of geometry or away from a surface
    Inside,       ///< inside geometry, with no free position in reach of a push
    TooClose,     ///< closer to a surface than the clearance, with no free position in reach
    Unreachable,  ///< in a space that is not to be filled
    Dark,         ///< in a space that no light reaches
    Forbidden,    ///< in an adjustment volume that forbids probes
    Crowded,      ///< too close to another probe
    Redundant,    ///< the light is as accurate without it
    Added,  ///< kept: no candidate, but without it a place would be outside of the tetrahedra,
            ///< or out of sight of all probes
};

inline constexpr int kFateCount = 10;

[[nodiscard]] inline bool is_kept(Fate fate) {
    return fate == Fate::Kept || fate == Fate::Pushed || fate == Fate::Added;
}

/// Metres from a position in render space to the nearest surface; infinite if there is none.
[[nodiscard]] float surface_distance(const TraceScene& traced, glm::vec3 position);

/// Which positions probes may have.
struct ClearanceRule {
    /// Minimum distance to every surface, metres; 0 = anywhere outside of geometry.
    double clearance = 0.0;
    /// The maximum distance of a push, metres.
    double max_push = 0.0;
    /// No push ends outside of this box.
    WorldBox bounds{glm::dvec3(-std::numeric_limits<double>::infinity()),
                    glm::dvec3(std::numeric_limits<double>::infinity())};
};

/// A candidate, its final position and its fate.
struct PlacedProbe {
    glm::dvec3 position{0.0};
    Fate fate = Fate::Kept;
    /// Distance to the nearest surface, metres; infinite if there is none.
    float surface_distance = 0.0f;

    bool operator==(const PlacedProbe&) const = default;
};

/// The positions of those that are kept, in their order.
[[nodiscard]] std::vector<glm::dvec3> kept_positions(std::span<const PlacedProbe> probes);

/// Keeps a free candidate, pushes one that is inside geometry or too close to a surface, or gives
/// the reason if there is no free position. A push passes through no surface except the one that
/// the candidate is behind. It is along one of the axes if possible, by the shortest distance,
/// which keeps the candidate in planes of its lattice, or else away from the nearest surface. Pure.
[[nodiscard]] PlacedProbe place_probe(const TraceScene& traced, const glm::dvec3& candidate,
                                      const ClearanceRule& rule);

/// The class of a position relative to the geometry around it.
enum class PointClass : uint8_t {
    Free,
    Uncertain,  ///< counts as free, but no probe is pushed there
    Inside,
};

/// Classifies a position in render space by the fractions of back faces around it
/// (`ProbeVisibility::is_inside`). If some but few are back faces, counts all surfaces out to the
/// sky in some directions: in intersecting solids the nearest surfaces may all be front faces.
[[nodiscard]] PointClass classify_point(const TraceScene& traced, glm::vec3 position,
                                        const ProbeVisibility& around);

/// True if a world position is PointClass::Free and `clearance` metres or more from all surfaces.
[[nodiscard]] bool is_free_with_clearance(const TraceScene& traced, const glm::dvec3& position,
                                          double clearance);

/// True if no surface is between two positions in render space.
[[nodiscard]] bool is_visible(const TraceScene& traced, glm::vec3 from, glm::vec3 to);

}  // namespace tetralight
