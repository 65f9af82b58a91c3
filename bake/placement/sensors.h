// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Where things may stand that probes light: positions in free space in turn with positions a
/// little off surfaces, by their area. A sequence that goes on for ever, evenly spread at every
/// length (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
class SensorSequence {
  public:
    /// Says whether a place is free, from many threads; corners are nearer to their other side than
    /// the offset.
    using Filter = std::function<bool(const glm::dvec3& position)>;

    /// Keeps the references. `surface_offset`: metres off surfaces.
    SensorSequence(const TraceScene& traced, const WorldBox& bounds, double surface_offset,
                   Filter is_free);

    /// About `count` more places: fewer where hardly any place is free.
    [[nodiscard]] std::vector<glm::dvec3> next(size_t count, uint32_t thread_count);

  private:
    [[nodiscard]] glm::dvec3 anywhere(uint64_t i) const;
    [[nodiscard]] glm::dvec3 off_a_surface(uint64_t i) const;
    [[nodiscard]] bool counts(const glm::dvec3& position) const;

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
