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

/// Draws points of the triangles that emit light: a triangle by its light at the shading point,
/// then a point of it uniformly by area.
class EmissiveTriangles {
  public:
    /// Keeps a reference. Emission is integrated over each triangle by a few texture lookups; what
    /// they miss is never drawn and has a density of 0.
    explicit EmissiveTriangles(const TraceScene& trace_scene);

    [[nodiscard]] bool is_empty() const { return tree_.is_empty(); }

    /// Light of one point. `choice` in [0, 1) draws the triangle and `u` the point. Zero irradiance
    /// when it turns its back to the shading point, or there is nothing of use.
    [[nodiscard]] LightSample sample(const ShadingPoint& shading_point, double choice,
                                     glm::vec2 u) const noexcept;

    /// Density per steradian with which `sample` draws the place that a ray from the shading point
    /// surface.
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
    /// For each geometry the number of its first triangle here, or `kNoIndex`: all of a geometry's
    /// triangles are here or none.
    std::vector<uint32_t> first_of_geometry_;
    LightTree tree_;
};

}  // namespace tetralight
