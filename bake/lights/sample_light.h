// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <tetralight/probes/light.h>

namespace tetralight {

/// A sampled direction from which light arrives at a position. Shadows are not included.
struct LightSample {
    /// Arriving radiance divided by the density of the direction, so that the irradiance of a
    /// surface is E(n) = mean over samples of irradiance · max(0, n · to_light).
    glm::vec3 irradiance{0.0f};
    glm::vec3 to_light{0.0f};
    /// End of the shadow ray. Unused if `is_distant`.
    glm::vec3 target{0.0f};
    bool is_distant = false;
    /// Density of the direction per steradian; 0 if rays cannot hit the light (punctual and area
    /// lights), so that no MIS weight applies.
    float pdf = 0.0f;
    /// Index of the light in the scene, or of the emissive geometry in the trace scene.
    uint32_t source = 0;

    bool operator==(const LightSample&) const = default;
};

/// Samples a point on the shape of the light for a position, with `u` uniform in [0, 1)²:
///
/// - directional lights: a disc of `radius` radians in the sky, uniform by solid angle;
/// - point and spot lights: a sphere of uniform radiance, uniform by solid angle. The mean is that
///   of `illuminate`. Within `radius` of the center, the sphere is shrunk to touch the position;
/// - rectangles: uniform by solid angle (Ureña, Fajardo & King 2013, "An Area-Preserving
///   Parametrization for Spherical Rectangles"), or by area below 1e-4 sr;
/// - discs: uniform by area.
///
/// Distance falloff and cone are those of `illuminate`, applied per point of rectangles and discs.
/// Zero irradiance if no light arrives.
[[nodiscard]] LightSample sample_light(const Light& light, glm::vec3 position,
                                       glm::vec2 u) noexcept;

/// True if all samples of the light are equal: it has no area.
[[nodiscard]] bool has_hard_shadows(const Light& light) noexcept;

}  // namespace tetralight
