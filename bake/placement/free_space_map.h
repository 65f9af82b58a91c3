// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

#include <tetralight/bake/placement/lattice.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {

/// The spaces of a scene: connected parts of its free space. A flood fill over the points of a
/// lattice joins neighbors (of 26) that are visible from each other.
///
///     FreeSpaceMap map(traced, bounds, spacing);
///     map.join(probes);
///     bool together = map.space_of(a) == map.space_of(b);
class FreeSpaceMap {
  public:
    /// The lattice covers the bounds and one step around them. Its step is half a metre, or
    /// `spacing` if that is less, and larger if the lattice would have more than a million points.
    /// An opening that no line between two points leads through counts as closed. Keeps a
    /// reference.
    FreeSpaceMap(const TraceScene& traced, const WorldBox& bounds, const glm::dvec3& spacing,
                 uint32_t thread_count = 0);

    /// Joins the spaces that are visible from the same position, such as a probe in a door.
    void join(std::span<const glm::dvec3> positions, uint32_t thread_count = 0);

    /// The space of a world position, as a number that `join` may change; kNoIndex if no point is
    /// visible from the position.
    [[nodiscard]] uint32_t space_of(const glm::dvec3& position) const;

    [[nodiscard]] std::vector<uint32_t> spaces_of(std::span<const glm::dvec3> positions,
                                                  uint32_t thread_count = 0) const;

    /// The points in a box by their space, without points on surfaces.
    [[nodiscard]] std::map<uint32_t, std::vector<glm::dvec3>> points_by_space(
        const WorldBox& box) const;

    [[nodiscard]] bool contains(const glm::dvec3& position) const;

  private:
    void fill(uint32_t thread_count);
    [[nodiscard]] glm::vec3 point(uint64_t i) const;
    [[nodiscard]] uint32_t root(uint32_t point) const;
    void unite(uint32_t a, uint32_t b);
    /// The points that are visible from a position: corners of its cell, or else of the cells
    /// around it.
    [[nodiscard]] std::vector<uint32_t> visible_points(const glm::dvec3& position) const;
    void append_visible(const glm::dvec3& position, int reach, std::vector<uint32_t>& points) const;

    const TraceScene& traced_;
    Lattice lattice_;
    std::vector<uint32_t> parent_;  ///< union-find: never larger than the point itself
    std::vector<bool> is_blocked_;  ///< points on a surface, which belong to neither side
};

}  // namespace tetralight
