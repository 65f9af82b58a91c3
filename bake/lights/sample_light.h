// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <tetralight/probes/light.h>

namespace tetralight {

/// One direction in which light arrives at a position, drawn at random; shadows left out.
struct LightSample {
    /// Arriving radiance over the density of the direction: irradiance of a surface that faces it,
    /// E(n) = mean of irradiance · max(0, n · to_light) over samples.
    glm::vec3 irradiance{0.0f};
    glm::vec3 to_light{0.0f};
    /// Where a shadow ray ends. Unused when the light is distant.
    glm::vec3 target{0.0f};
    bool is_distant = false;
    /// Density of the direction, per steradian; 0 when rays cannot meet the light by chance.
    float pdf = 0.0f;
    /// Which emitter of its kind: a light of the scene, a geometry of the trace scene.
    uint32_t source = 0;

    bool operator==(const LightSample&) const = default;
};

/// A point of the light's shape that lights `position`, for `u` uniform in [0, 1)²:
///
/// - directional lights: a disc in the sky of `radius` radians, uniform by solid angle;
/// - points and spots: a sphere of uniform radiance, uniform by the solid angle it covers. Its mean
///   is that of `illuminate`. Within the sphere it shrinks to end at the position;
/// - rectangles: uniform by solid angle (Ureña, Fajardo & King 2013, "An Area-Preserving
///   Parametrization for Spherical Rectangles"), by area where they are tiny;
/// - discs: uniform by area.
///
/// Distance falloff and cone are those of `illuminate`, for each point of rectangles and discs.
/// Zero irradiance where no light arrives.
[[nodiscard]] LightSample sample_light(const Light& light, glm::vec3 position,
                                       glm::vec2 u) noexcept;

/// Whether every sample of the light is the same.
[[nodiscard]] bool has_hard_shadows(const Light& light) noexcept;

}  // namespace tetralight
