// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <type_traits>

namespace tetralight {

enum class LightType : uint32_t {
    Directional = 0,
    Point = 1,
    Spot = 2,
    /// Emits from one side only, brightest along `direction` (Lambert): `extras.shape` of a light.
    Rectangle = 3,
    Disc = 4,
};

/// How the light of point, spot, rectangle and disc lights falls off with distance d. `Linear` and
/// `Legacy` do not grow near the light: there `intensity` is the irradiance at distance 0, in lux.
enum class LightFalloff : uint32_t {
    Gltf = 0,                ///< sat(1 − (d/range)⁴) / d², KHR_lights_punctual
    InverseSquareRange = 1,  ///< sat(1 − (d/range)⁴)² / d²
    Linear = 2,              ///< sat(1 − d/range)
    Legacy = 3,              ///< 1 / (1 + 25 (d/range)²), faded to 0 from 0.8 of the range on
};

/// Which part of a light is baked into the probes (docs/conventions.md).
enum class LightMode : uint32_t {
    Mixed = 0,     ///< its bounces; the runtime adds the direct term with a shadow
    Baked = 1,     ///< its bounces and its direct light
    Realtime = 2,  ///< nothing; the runtime adds the direct term with a shadow
};

/// A light with the meaning and units of glTF's KHR_lights_punctual, and what that leaves out.
/// Stored in probe volumes in this layout, so that a runtime can add the direct term of `Mixed`
/// lights.
struct Light {
    LightType type = LightType::Directional;
    LightMode mode = LightMode::Mixed;
    /// Colour × intensity, linear Rec.709: lux for directional lights, candela for the others (of
    /// rectangles and discs: straight ahead).
    glm::vec3 intensity{1.0f};
    /// Unused by directional lights.
    glm::vec3 position{0.0f};
    /// Unit vector in which the light shines (from it, not towards it). Unused by point lights.
    glm::vec3 direction{0.0f, 0.0f, -1.0f};
    /// Distance in metres at which the light ends; 0 = never.
    float range = 0.0f;
    /// Cosines of the spot cone's half angles.
    float cos_inner_cone = 1.0f;
    float cos_outer_cone = 0.7071067811865476f;
    LightFalloff falloff = LightFalloff::Gltf;
    /// Scales the light's bounces, not its direct light.
    float indirect_multiplier = 1.0f;
    /// Soft shadows: radius of a point or spot light's sphere and of a disc, metres; half the angle
    /// that a directional light covers in the sky, radians. 0 = hard shadows.
    float radius = 0.0f;
    /// Rectangles: unit vector along the width, at right angles to `direction`.
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};
    /// Rectangles: metres.
    float width = 0.0f;
    float height = 0.0f;

    bool operator==(const Light&) const = default;
};

static_assert(sizeof(Light) == 88 && alignof(Light) == 4 && std::is_trivially_copyable_v<Light>);

/// Light that arrives at one position from one light, without shadows.
struct Illumination {
    /// Irradiance on a surface that faces the light: E(n) = irradiance · max(0, n · to_light).
    glm::vec3 irradiance{0.0f};
    glm::vec3 to_light{0.0f};
    /// Where a shadow ray ends; infinite for directional lights.
    float distance = 0.0f;
};

/// Irradiance on a surface that faces a point light of intensity 1 at a distance > 0: the formula
/// of the light's falloff, without its factors of the range if that is 0. 1 for directional lights.
[[nodiscard]] float evaluate_falloff(const Light& light, float distance) noexcept;

/// Fraction of a light's intensity that it emits along −`to_light` (unit): the squared ramp between
/// a spot light's cosines (KHR_lights_punctual), the cosine of rectangles and discs on their front,
/// 1 for the others.
[[nodiscard]] float evaluate_emission_profile(const Light& light, glm::vec3 to_light) noexcept;

/// Area of a rectangle or disc, square metres; 0 for the others. With it,
/// intensity / area is the radiance that the surface shows on its front.
[[nodiscard]] float light_area(const Light& light) noexcept;

/// E = intensity · profile · falloff. `radius` is left out, since it only softens shadows. Of
/// rectangles and discs this is the view from afar, where they are points; under 1/d² falloffs the
/// area A bounds it nearby as 1/(d² + A/π), which is exact on the axis of a disc.
[[nodiscard]] Illumination illuminate(const Light& light, glm::vec3 position) noexcept;

}  // namespace tetralight
