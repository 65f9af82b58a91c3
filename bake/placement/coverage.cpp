// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/coverage.h>

#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/bake/blocked_fraction.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {
namespace {

/// Bound of the rounding of a float position in the volume, metres.
double rounding_at(const ProbeVolumeView& volume, const glm::dvec3& place) {
    const double size = glm::length(place) + double{volume.info.extent};
    return 4.0 * double{std::numeric_limits<float>::epsilon()} * size;
}

/// True if a place differs from the weighted mean of up to three corners by more than rounding.
bool is_off_corners(const ProbeVolumeView& volume, const CellLocation& location,
                    const glm::dvec3& place) {
    glm::dvec3 mean = volume.info.world_origin;
    for (int i = 0; i < 3; ++i) {
        const uint32_t probe = volume.cells[location.cell].vertices[static_cast<size_t>(i)];
        if (probe >= volume.probe_count()) continue;
        mean += double{location.weights[i]} * glm::dvec3(volume.positions[probe]);
    }
    return glm::distance(mean, place) > rounding_at(volume, place);
}

}  // namespace

glm::vec3 probe_eye(const TraceScene& traced, const ProbeVolumeView& volume, uint32_t probe) {
    const size_t count = volume.positions.size();
    glm::dvec3 position = volume.exact_positions.size() == count
                              ? volume.exact_positions[probe]
                              : volume.info.world_origin + glm::dvec3(volume.positions[probe]);
    if (volume.health.size() == count) position += volume.health[probe].virtual_offset;
    return traced.render_from_world(position);
}

bool is_in_hull_cell(const ProbeVolumeView& volume, const CellLocation& location,
                     const glm::dvec3& place) {
    if (location.cell >= volume.cells.size()) return true;
    if (location.cell < volume.info.inner_cell_count) return false;
    return is_off_corners(volume, location, place);
}

bool is_off_flat_cell(const ProbeVolumeView& volume, const CellLocation& location,
                      const glm::dvec3& place) {
    if (location.cell >= volume.cells.size()) return true;
    return volume.info.dimension != Dimension::Space && is_off_corners(volume, location, place);
}

bool sees_enough(const TraceScene& traced, const ProbeVolumeView& volume,
                 const CellLocation& location, const glm::dvec3& place) {
    if (location.cell >= volume.cells.size()) return false;
    const glm::vec3 here = traced.render_from_world(place);
    const Cell& cell = volume.cells[location.cell];
    float seen = 0.0f, hidden = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
        const float weight = location.weights[i];
        if (probe >= volume.probe_count() || !(weight > 0.0f)) continue;
        const glm::vec3 eye = probe_eye(traced, volume, probe);
        (eye == here || !blocked_fraction(traced, eye, here) ? seen : hidden) += weight;
        if (seen >= kMinSeenWeight) return true;
        if (hidden > 1.0f - kMinSeenWeight) return false;
    }
    return false;
}

Cover cover_of(const TraceScene& traced, const ProbeVolumeView& volume, const glm::dvec3& place) {
    const CellLocation location = locate(volume, glm::vec3(place));
    if (is_in_hull_cell(volume, location, place)) return Cover::HullCell;
    return sees_enough(traced, volume, location, place) ? Cover::Covered : Cover::Unseen;
}

std::vector<Cover> find_cover(const TraceScene& traced, const ProbeVolumeView& volume,
                              std::span<const glm::dvec3> places, uint32_t thread_count) {
    std::vector<Cover> covers(places.size());
    parallel_for(places.size(), thread_count,
                 [&](size_t i) { covers[i] = cover_of(traced, volume, places[i]); });
    return covers;
}

Coverage count_cover(std::span<const Cover> covers) {
    Coverage coverage;
    for (const Cover cover : covers) ++coverage.counts[static_cast<size_t>(cover)];
    return coverage;
}

}  // namespace tetralight
