// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight::bench {

/// The free space that bodies reach, found without the generator: a flood over the points of a
/// lattice that are 10 cm or more off all surfaces, along rays between neighbors. Every surface
/// stops these rays, glass too.
class ReachableSpace {
  public:
    /// Returns true if bodies may be in a space, which some of its positions tell.
    using Filter = std::function<bool(std::span<const glm::dvec3> positions)>;

    /// The lattice's step is 25 cm, and larger if it would have more than two million points.
    /// Without seeds the space is the largest one that the filter accepts. Keeps a reference.
    ReachableSpace(const TraceScene& traced, const WorldBox& bounds,
                   std::span<const glm::dvec3> from, const Filter& is_wanted);

    /// True if a ray from the world position meets a point of the space, at most two steps away on
    /// each axis.
    [[nodiscard]] bool contains(const glm::dvec3& position) const;

  private:
    using Steps = std::array<int64_t, 3>;

    [[nodiscard]] size_t point_count() const;
    [[nodiscard]] glm::dvec3 at(size_t point) const;
    [[nodiscard]] size_t index_of(const Steps& steps) const;
    [[nodiscard]] bool is_free_between(const glm::dvec3& a, const glm::dvec3& b) const;
    void find_links();
    /// Marks all points that are joined to the first ones, and returns them.
    std::vector<size_t> flood(std::vector<size_t> points);
    void flood_largest(const Filter& is_wanted);
    [[nodiscard]] std::vector<glm::dvec3> some_of(std::span<const size_t> points) const;
    /// Points around a position that a ray reaches.
    template <class Accept>
    [[nodiscard]] std::vector<size_t> seen_from(const glm::dvec3& position, Accept&& accepts,
                                                size_t most) const;

    const TraceScene& traced_;
    glm::dvec3 first_{0.0};
    double step_ = 0.0;
    Steps counts_{};
    std::vector<uint8_t> links_;       ///< bit i: joined to the next point on axis i
    std::vector<uint8_t> is_free_;     ///< off surfaces
    std::vector<uint8_t> is_reached_;  ///< in the space
};

}  // namespace tetralight::bench
