// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include <tetralight/bake/lights/emissive_triangles.h>
#include <tetralight/bake/lights/environment_sampler.h>
#include <tetralight/bake/lights/light_tree.h>
#include <tetralight/bake/lights/punctual_lights.h>
#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// The kinds of lights. Each kind is sampled separately: before shadows are known, the light of
/// different kinds cannot be compared.
enum class LightKind {
    Directional,  ///< directional lights of the scene
    Local,        ///< point, spot, rectangle and disc lights of the scene
    Triangle,     ///< emissive triangles
    Sky,          ///< the environment image
};

/// Samples all lights of a scene, in render space.
class LightSampler {
  public:
    /// Scales the lights by their `indirect_multiplier`, as bounces receive them. Keeps references.
    LightSampler(const Scene& scene, const TraceScene& trace_scene);

    [[nodiscard]] bool has(LightKind kind) const noexcept;

    /// Light of one sampled light of a kind, without shadows. Precondition: `has(kind)`.
    [[nodiscard]] LightSample sample(LightKind kind, const ShadingPoint& shading_point,
                                     Sampler& sampler) const noexcept;

    /// Density per steradian with which `sample` returns what a ray from the shading point hit: a
    /// triangle here, a sky direction below. 0 = never sampled.
    [[nodiscard]] float pdf(const ShadingPoint& shading_point,
                            const Surface& surface) const noexcept {
        return triangles_.pdf(shading_point, surface);
    }

    [[nodiscard]] float pdf(glm::vec3 sky_direction) const noexcept {
        return sky_.pdf(sky_direction);
    }

    /// The directional lights, scaled, with their indices in the scene.
    [[nodiscard]] std::vector<std::pair<Light, uint32_t>> directional_lights() const {
        return punctual_lights_.directional_lights();
    }

  private:
    [[nodiscard]] LightSample sample_sky(glm::vec2 u) const noexcept;

    const Environment& environment_;
    PunctualLights punctual_lights_;
    EmissiveTriangles triangles_;
    EnvironmentSampler sky_;
};

}  // namespace tetralight
