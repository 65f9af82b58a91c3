// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// Random places of the free space that a volume lights, to measure its answers at:
//
//     make_probe_eyes → find_free_places ─┬→ find_unseen (pipeline/unseen_places.h)
//                                         └→ check_leaks (pipeline/check_leaks.h)

namespace tetralight {

/// Where the probes of a volume sample their light, as ends of rays. One element a probe.
struct ProbeEyes {
    /// Render space: the position of the probe plus its virtual offset.
    std::vector<glm::vec3> positions;
    /// 1 if that is inside geometry.
    std::vector<uint8_t> is_inside;
};

/// The eyes of the probes of a volume. `min_validity`: as in `HealthSettings`.
[[nodiscard]] ProbeEyes make_probe_eyes(const TraceScene& traced, const ProbeVolumeView& volume,
                                        float min_validity, uint32_t thread_count = 0);

/// A position in free space.
struct FreePlace {
    /// World space.
    glm::vec3 position{0.0f};
    /// With weights that know no walls.
    CellLocation location;
    /// One a corner of the cell: true if its weight is not 0 and a ray from the probe's eye reaches
    /// the place (`blocked_fraction`).
    std::array<bool, 4> is_seen{};

    /// True if no corner of the cell sees the place.
    [[nodiscard]] bool is_unseen() const {
        return !is_seen[0] && !is_seen[1] && !is_seen[2] && !is_seen[3];
    }

    bool operator==(const FreePlace&) const = default;
};

struct FreePlaceSettings {
    uint32_t count = 1000;
    /// Least distance from all surfaces, metres.
    float clearance = 0.05f;
    uint64_t seed = 0;
    /// Positions that are drawn at most for each place.
    uint32_t most_draws = 8;
    /// A place is inside geometry if the fraction of rays that hit no back face is below this.
    float min_validity = 0.75f;
    /// Number of threads; 0 = all.
    uint32_t thread_count = 0;
};

struct FreePlaces {
    /// As many as asked for, or fewer if they are rare.
    std::vector<FreePlace> places;
    /// Positions that were drawn until enough of them were free.
    uint64_t drawn_count = 0;
    /// The median length of the volume's edges, metres; 0 without edges.
    float spacing = 0.0f;
};

/// Draws positions evenly in the box of the probes, grown by half the spacing on each side (by 1 m
/// without edges), and keeps those in free space:
///
/// - at least `clearance` off all surfaces,
/// - not inside geometry: a probe in free space sees the place, or the rays of
///   `probe_visibility` say so,
/// - of those outside the hull of the probes, only places that a ray from a corner of their cell or
///   from one of the 16 nearest probes reaches. So the outside of a closed building is left out. In
///   volumes of a plane, a line or a point, which enclose no space, this holds for all places.
///
/// A pure function: the same places for any number of threads. None if the volume has no probes.
/// Precondition: one eye a probe.
[[nodiscard]] FreePlaces find_free_places(const TraceScene& traced, const ProbeEyes& eyes,
                                          const ProbeVolumeView& volume,
                                          const FreePlaceSettings& settings);

}  // namespace tetralight
