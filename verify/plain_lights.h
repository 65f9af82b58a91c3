// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/probes/light.h>
#include <tetralight/verify/pcg.h>

// How the referee samples lights: with equal chances, without a tree and without regard to the
// place that they light.

namespace tetralight {

/// Light that arrives from one direction, before shadows.
struct PlainLightSample {
    /// Arriving radiance divided by the density of the direction.
    glm::vec3 irradiance{0.0f};
    glm::vec3 to_light{0.0f};
    /// Where the shadow ray ends, metres; infinite for directional lights.
    float distance = 0.0f;
};

/// A uniform point on the shape of a punctual or area light: on the disc of a sun in the sky, on
/// the part of a sphere that faces the position, on the area of a rectangle or disc.
[[nodiscard]] PlainLightSample sample_plain_light(const Light& light, glm::vec3 position,
                                                  Pcg& random);

/// Lights that rays cannot hit.
class PlainLights {
  public:
    /// In render space.
    explicit PlainLights(std::vector<Light> lights) : lights_(std::move(lights)) {}

    /// Up to four lights, each chosen among its share of all of them.
    [[nodiscard]] uint32_t draw_count() const {
        return static_cast<uint32_t>(lights_.size() < 4 ? lights_.size() : 4);
    }

    /// Draw `i` of `draw_count`. The sum over all draws estimates the light of all lights.
    [[nodiscard]] PlainLightSample sample(uint32_t i, glm::vec3 position, Pcg& random) const;

  private:
    std::vector<Light> lights_;
};

/// Triangles that emit, chosen by area times the emission factor of their material.
class PlainEmitters {
  public:
    PlainEmitters(const Scene& scene, const TraceScene& traced);

    [[nodiscard]] bool is_empty() const { return triangles_.empty(); }

    /// A direction from a position to a point on a triangle.
    struct Choice {
        glm::vec3 direction{0.0f};  ///< unit vector; zero at the point itself
        glm::vec3 point{0.0f};
        /// Metres that the point is away from the edges of its triangle, at least.
        float edge_distance = 0.0f;
        glm::vec3 normal{0.0f};  ///< unit, on the front
        uint32_t geometry = 0;
        uint32_t primitive = 0;
    };

    [[nodiscard]] Choice sample(glm::vec3 position, Pcg& random) const;

    /// True if the surface that the ray from `origin` hit is what was chosen: the same triangle, or
    /// one of the same geometry that continues it where the point is so near to an edge that
    /// rounding moves the hit across.
    [[nodiscard]] static bool is_chosen(const Choice& choice, glm::vec3 origin,
                                        const Surface& surface);

    /// Density per steradian with which `sample` finds a surface that a ray from `origin` hit.
    [[nodiscard]] float pdf(glm::vec3 origin, glm::vec3 direction, const Surface& surface) const;

  private:
    struct Triangle {
        std::array<glm::vec3, 3> corners{};
        uint32_t geometry = 0;
        uint32_t primitive = 0;
    };

    std::vector<Triangle> triangles_;
    /// Sum of area times weight up to and with each triangle.
    std::vector<double> sums_;
    /// One a geometry of the trace scene: chance per square metre.
    std::vector<float> density_;
};

}  // namespace tetralight
