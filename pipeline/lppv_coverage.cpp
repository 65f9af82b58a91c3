// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lppv_coverage.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include <tetralight/bake/parallel.h>
#include <tetralight/base/box.h>
#include <tetralight/base/contract.h>
#include <tetralight/pipeline/spread_positions.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {
namespace {

/// The cover of each point; none of points that do not count.
using PointCovers = std::vector<std::optional<Cover>>;

/// The distance between probes that fill their box evenly, metres.
double mean_spacing(const ProbeVolumeView& volume) {
    if (volume.positions.empty()) return 0.0;
    auto box = Box<glm::vec3>::empty();
    for (const glm::vec3& position : volume.positions) box = union_of(box, position);
    const glm::dvec3 size(box.max - box.min);
    return std::cbrt(size.x * size.y * size.z / static_cast<double>(volume.positions.size()));
}

/// Calls `cover_of_point(i, position, location)` for each point, on threads by rows: batches find
/// the cells of neighbors faster than single queries.
template <class CoverOfPoint>
PointCovers cover_points(const ProbeVolumeView& volume, const LppvGrid& grid, uint32_t thread_count,
                         CoverOfPoint cover_of_point) {
    PointCovers covers(grid.point_count());
    const size_t length = grid.resolution.x;
    parallel_for(grid.point_count() / length, thread_count, [&](size_t row) {
        std::vector<glm::vec3> positions(length);
        std::vector<CellLocation> locations(length);
        for (size_t x = 0; x < length; ++x) {
            positions[x] = glm::vec3(grid.world_position(grid.point(row * length + x)));
        }
        locate(volume, positions, locations);
        for (size_t x = 0; x < length; ++x) {
            const size_t i = row * length + x;
            covers[i] = cover_of_point(i, grid.world_position(grid.point(i)), locations[x]);
        }
    });
    return covers;
}

LppvCoverage summarize(const ProbeVolumeView& volume, const LppvGrid& grid,
                       const PointCovers& covers) {
    LppvCoverage coverage;
    std::array<std::vector<glm::dvec3>, kCoverCount> uncovered;
    for (size_t i = 0; i < covers.size(); ++i) {
        if (!covers[i]) continue;
        const auto cover = static_cast<size_t>(*covers[i]);
        ++coverage.points.counts[cover];
        if (*covers[i] == Cover::Covered) continue;
        uncovered[cover].push_back(grid.world_position(grid.point(i)));
    }
    const bool has_both =
        coverage.points.count(Cover::HullCell) > 0 && coverage.points.count(Cover::Unseen) > 0;
    const size_t most = has_both ? kMostSpreadPositions / 2 : kMostSpreadPositions;
    const double spacing = mean_spacing(volume);
    for (const Cover cover : {Cover::HullCell, Cover::Unseen}) {
        const auto& positions = uncovered[static_cast<size_t>(cover)];
        for (const size_t i : spread_positions(positions, spacing, most)) {
            coverage.positions.push_back({rounded_to_millimetre(positions[i]), cover});
        }
    }
    return coverage;
}

bool encloses_space(const ProbeVolumeView& volume) {
    return volume.info.dimension == Dimension::Space;
}

bool is_at_surface(const TraceScene& traced, const glm::dvec3& position) {
    const glm::vec3 here = traced.render_from_world(position);
    const auto nearest = traced.nearest_surface(here);
    return nearest && glm::distance(here, *nearest) < kLppvClearance;
}

/// The cover of a point that is not inside geometry. The nearest surface takes longer to find than
/// rays to the corners: covered points do not need it.
std::optional<Cover> cover_in(const TraceScene& traced, const ProbeVolumeView& volume,
                              const glm::dvec3& position, const CellLocation& location) {
    const bool is_outside = is_in_hull_cell(volume, location, position);
    if (is_outside && !encloses_space(volume)) return std::nullopt;
    const bool is_seen = sees_enough(traced, volume, location, position);
    if (is_seen && !is_outside) return Cover::Covered;
    const bool is_beyond_walls = is_outside && !is_seen;
    if (is_beyond_walls || is_at_surface(traced, position)) return std::nullopt;
    return is_outside ? Cover::HullCell : Cover::Unseen;
}

}  // namespace

LppvCoverage find_lppv_coverage(const ProbeVolumeView& volume, const LppvGrid& grid,
                                uint32_t thread_count) {
    const auto cover = [&](size_t, const glm::dvec3& position,
                           const CellLocation& location) -> std::optional<Cover> {
        if (!is_in_hull_cell(volume, location, position)) return Cover::Covered;
        return encloses_space(volume) ? std::optional(Cover::HullCell) : std::nullopt;
    };
    return summarize(volume, grid, cover_points(volume, grid, thread_count, cover));
}

LppvCoverage find_lppv_coverage(const ProbeVolumeView& volume, const LppvGrid& grid,
                                const LppvSurroundings& around, uint32_t thread_count) {
    TETRALIGHT_ASSERT(around.validity.size() == grid.point_count(), "one a grid point");
    const auto cover = [&](size_t i, const glm::dvec3& position,
                           const CellLocation& location) -> std::optional<Cover> {
        if (around.validity[i] < around.min_validity) return std::nullopt;
        return cover_in(around.traced, volume, position, location);
    };
    return summarize(volume, grid, cover_points(volume, grid, thread_count, cover));
}

}  // namespace tetralight
