// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Positions of objects that probes light: alternately in free space and a little off surfaces, in
/// proportion to area. An infinite low-discrepancy sequence (Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences").
class SensorSequence {
  public:
    /// Returns true if a position is free; called from many threads. In corners, positions off one
    /// surface are closer than the offset to another.
    using Filter = std::function<bool(const glm::dvec3& position)>;

    /// Keeps the references. `surface_offset`: distance from surfaces, metres.
    SensorSequence(const TraceScene& traced, const WorldBox& bounds, double surface_offset,
                   Filter is_free);

    /// The next `count` positions; fewer if hardly any position is free.
    [[nodiscard]] std::vector<glm::dvec3> next(size_t count, uint32_t thread_count);

  private:
    [[nodiscard]] glm::dvec3 in_bounds(uint64_t i) const;
    [[nodiscard]] glm::dvec3 off_a_surface(uint64_t i) const;
    [[nodiscard]] bool is_usable(const glm::dvec3& position) const;

    struct Triangle {
        uint32_t geometry = 0;
        uint32_t primitive = 0;
    };

    const TraceScene& traced_;
    WorldBox bounds_;
    double surface_offset_;
    Filter is_free_;
    std::vector<Triangle> triangles_;
    std::vector<double> area_sums_;  ///< of the triangles up to each
    uint64_t tried_ = 0;
};

}  // namespace tetralight
