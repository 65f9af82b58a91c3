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

/// Which places can be reached from which, without passing through a surface: a flood fill over a
/// lattice of posts, joined where neighbors (of 26) see each other.
///
///     FreeSpaceMap map(traced, bounds, spacing);
///     map.join(probes);
///     bool together = map.space_of(a) == map.space_of(b);
class FreeSpaceMap {
  public:
    /// Posts stand half a metre apart, or as far as `spacing` where that is less, in the bounds and
    /// one step around them; farther where they would be more than a million. Openings that no line
    /// between two posts leads through are taken for closed. Keeps a reference.
    FreeSpaceMap(const TraceScene& traced, const WorldBox& bounds, const glm::dvec3& spacing,
                 uint32_t thread_count = 0);

    /// Joins the spaces that each of some world positions sees: probes in doors.
    void join(std::span<const glm::dvec3> positions, uint32_t thread_count = 0);

    /// The space that a world position lies in, as a number that `join` changes; kNoIndex: it sees
    /// no post.
    [[nodiscard]] uint32_t space_of(const glm::dvec3& position) const;

    [[nodiscard]] std::vector<uint32_t> spaces_of(std::span<const glm::dvec3> positions,
                                                  uint32_t thread_count = 0) const;

    /// The posts in a box, but for those on a surface, by the space that they lie in.
    [[nodiscard]] std::map<uint32_t, std::vector<glm::dvec3>> points_by_space(
        const WorldBox& box) const;

    [[nodiscard]] bool contains(const glm::dvec3& position) const;

  private:
    void fill(uint32_t thread_count);
    [[nodiscard]] glm::vec3 post(uint64_t i) const;
    [[nodiscard]] uint32_t root(uint32_t post) const;
    void unite(uint32_t a, uint32_t b);
    /// The posts around a position that it sees: of the cell that it lies in, or else of those
    /// around that.
    [[nodiscard]] std::vector<uint32_t> visible_points(const glm::dvec3& position) const;
    void look(const glm::dvec3& position, int reach, std::vector<uint32_t>& posts) const;

    const TraceScene& traced_;
    Lattice posts_;
    std::vector<uint32_t> parent_;  ///< union-find: never larger than the post itself
    std::vector<bool> is_blocked_;  ///< posts on a surface, which belong to neither side
};

}  // namespace tetralight
