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
/// lattice joins neighbors (of 26) between which a ball of a given radius passes.
///
///     FreeSpaceMap map(traced, {bounds, spacing, radius});
///     map.join(probes);
///     bool together = map.space_of(a) == map.space_of(b);
class FreeSpaceMap {
  public:
    struct Rule {
        WorldBox bounds;
        /// Metres between probes: spaces that hold one are found.
        glm::dvec3 spacing{0.5};
        /// Of the body that moves from space to space, metres; 0 = a point.
        double radius = 0.0;
        uint32_t thread_count = 0;
    };

    /// The lattice covers the bounds and one step around them. Its step is a quarter of a metre, or
    /// less if the spacing is or if doors of 80 cm leave the body less; it is larger if the lattice
    /// would have more than two million points. Keeps a reference.
    FreeSpaceMap(const TraceScene& traced, const Rule& rule);

    /// Joins the spaces that the body reaches from the same position, such as a probe in a door.
    /// Positions where it does not fit join nothing.
    void join(std::span<const glm::dvec3> positions, uint32_t thread_count = 0);

    /// The space of a world position, as a number that `join` may change; kNoIndex if no way leads
    /// to a point nearby. Where the body does not fit, the way is for one that does.
    [[nodiscard]] uint32_t space_of(const glm::dvec3& position) const;

    [[nodiscard]] std::vector<uint32_t> spaces_of(std::span<const glm::dvec3> positions,
                                                  uint32_t thread_count = 0) const;

    /// The points in a box by their space, without those where the body does not fit.
    [[nodiscard]] std::map<uint32_t, std::vector<glm::dvec3>> points_by_space(
        const WorldBox& box) const;

    [[nodiscard]] bool contains(const glm::dvec3& position) const;

    /// The volume for which one point stands, m³.
    [[nodiscard]] double point_volume() const;

  private:
    void fill(uint32_t thread_count);
    /// Metres to the nearest surface, at most `far_`.
    [[nodiscard]] float distance_at(glm::vec3 position) const;
    [[nodiscard]] bool passes(glm::vec3 from, glm::vec3 to, float radius) const;
    /// True if the body fits at a point.
    [[nodiscard]] bool has_room(uint64_t i) const;
    [[nodiscard]] bool is_linked(uint64_t a, uint64_t b) const;
    [[nodiscard]] glm::vec3 point(uint64_t i) const;
    [[nodiscard]] uint32_t root(uint32_t point) const;
    void unite(uint32_t a, uint32_t b);
    /// The points that a ball reaches from a position: corners of its cell, or else of the cells
    /// around it, as far as the body is wide.
    [[nodiscard]] std::vector<uint32_t> reached_points(const glm::dvec3& position,
                                                       float radius) const;
    void append_reached(const glm::dvec3& position, int reach, float radius,
                        std::vector<uint32_t>& points) const;

    const TraceScene& traced_;
    Lattice lattice_;
    float radius_;
    /// Distances are cut off here, metres: with this much room the body passes to any neighbor.
    float far_;
    std::vector<uint32_t> parent_;  ///< union-find: never larger than the point itself
    std::vector<float> distances_;  ///< `distance_at` the points
};

}  // namespace tetralight
