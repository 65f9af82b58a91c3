// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include <tetralight/bake/lights/light_tree.h>
#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// Samples points on emissive triangles: a triangle by its estimated light at the shading point,
/// then a point on it uniformly by area.
class EmissiveTriangles {
  public:
    /// Keeps a reference. The emission of a triangle is estimated from a few texture lookups; if
    /// all of them are black, the triangle is never sampled and has density 0.
    explicit EmissiveTriangles(const TraceScene& trace_scene);

    [[nodiscard]] bool is_empty() const { return tree_.is_empty(); }

    /// Light of one point, without shadows. `choice` in [0, 1) selects the triangle and `u` the
    /// point. Zero irradiance if the triangle faces away from the shading point, or no triangle can
    /// light it.
    [[nodiscard]] LightSample sample(const ShadingPoint& shading_point, double choice,
                                     glm::vec2 u) const noexcept;

    /// Density per steradian with which `sample` returns a surface point that a ray from the
    /// shading point hit.
    [[nodiscard]] float pdf(const ShadingPoint& shading_point,
                            const Surface& surface) const noexcept;

  private:
    struct Triangle {
        glm::vec3 corner{0.0f};
        glm::vec3 edges[2];
        uint32_t geometry = 0;
        uint32_t primitive = 0;
    };

    void add(uint32_t geometry, uint32_t primitive, std::vector<LightBounds>& bounds);

    const TraceScene& trace_scene_;
    std::vector<Triangle> triangles_;
    /// The index of the first triangle of each geometry, or kNoIndex: either all triangles of a
    /// geometry are in `triangles_` or none.
    std::vector<uint32_t> first_of_geometry_;
    LightTree tree_;
};

}  // namespace tetralight
