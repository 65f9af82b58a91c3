// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// How the probes of a volume light a place in free space.
enum class Cover : uint8_t {
    Covered,   ///< inside the tetrahedra; the corners that it sees have enough weight
    HullCell,  ///< outside of the tetrahedra, in a hull cell
    Unseen,    ///< inside them, but walls hide it from corners with most of the weight
};

inline constexpr int kCoverCount = 3;

/// The corners of its cell that a covered place sees have this weight together, or more. The
/// weights are barycentric: they know no walls.
inline constexpr float kMinSeenWeight = 0.25f;

/// True if a place is in a hull cell, and off the hull by more than the rounding of float
/// positions: places on the hull are between probes. `location` is that of the place, by the policy
/// `OutsidePolicy::Extrapolate`. True without a cell.
[[nodiscard]] bool is_in_hull_cell(const ProbeVolumeView& volume, const CellLocation& location,
                                   const glm::dvec3& place);

/// True if the volume is a plane, a line or a point, and the place is off it. Cells of such volumes
/// hold all places in front of them.
[[nodiscard]] bool is_off_flat_cell(const ProbeVolumeView& volume, const CellLocation& location,
                                    const glm::dvec3& place);

/// Where a probe samples its light, in render space: its exact position and its virtual offset.
[[nodiscard]] glm::vec3 probe_eye(const TraceScene& traced, const ProbeVolumeView& volume,
                                  uint32_t probe);

/// True if the corners of its cell that a place sees have `kMinSeenWeight` together, or more. Rays
/// decide (`blocked_fraction`), from where the probes sample their light (`probe_eye`). `location`
/// is that of the place, also in a hull cell.
[[nodiscard]] bool sees_enough(const TraceScene& traced, const ProbeVolumeView& volume,
                               const CellLocation& location, const glm::dvec3& place);

/// The cover of one place, in world space, by both of these. In volumes of a plane, a line or a
/// point a place is in a hull cell if it is beside all cells that are not.
[[nodiscard]] Cover cover_of(const TraceScene& traced, const ProbeVolumeView& volume,
                             const glm::dvec3& place);

/// The cover of each place. A pure function.
[[nodiscard]] std::vector<Cover> find_cover(const TraceScene& traced, const ProbeVolumeView& volume,
                                            std::span<const glm::dvec3> places,
                                            uint32_t thread_count = 0);

/// How many places have which cover.
struct Coverage {
    std::array<uint64_t, kCoverCount> counts{};

    [[nodiscard]] uint64_t count(Cover cover) const { return counts[static_cast<size_t>(cover)]; }

    [[nodiscard]] uint64_t place_count() const { return counts[0] + counts[1] + counts[2]; }

    /// The share of the places with this cover; 0 if there are no places.
    [[nodiscard]] double share(Cover cover) const {
        const uint64_t all = place_count();
        return all == 0 ? 0.0 : static_cast<double>(count(cover)) / static_cast<double>(all);
    }

    bool operator==(const Coverage&) const = default;
};

[[nodiscard]] Coverage count_cover(std::span<const Cover> covers);

}  // namespace tetralight
