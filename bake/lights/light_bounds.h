// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <limits>

namespace tetralight {

/// Bounds of the position, direction and power of one or more lights (LightBounds of pbrt-4; the
/// cone is that of Conty Estevez & Kulla 2018, section 4).
struct LightBounds {
    glm::vec3 min{0.0f};
    glm::vec3 max{0.0f};
    /// Unit axis of the cone that contains the normals of the lights.
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    /// Cosine of θ_o, the half angle of that cone; −1 = emits in all directions.
    float cos_theta_o = -1.0f;
    /// Cosine of θ_e, the largest angle to its own normal at which a light emits.
    float cos_theta_e = -1.0f;
    /// True if the lights emit the same on the back side.
    bool is_two_sided = false;
    /// Σ intensity along the normal: irradiance · distance², in any unit.
    float power = 0.0f;
    /// Distance from the box, metres, from which on no light arrives.
    float max_distance = std::numeric_limits<float>::infinity();

    bool operator==(const LightBounds&) const = default;
};

/// The scalar power of an RGB colour: the sum of its channels.
[[nodiscard]] inline float power_of(glm::vec3 c) noexcept {
    return c.r + c.g + c.b;
}

/// Bounds of both. Bounds without power are ignored.
[[nodiscard]] LightBounds union_of(LightBounds a, LightBounds b) noexcept;

/// Surface area orientation heuristic: power · solid angle of the emission · surface area of the
/// box (Conty Estevez & Kulla 2018, equation 1 and the paragraph before it). The light tree is
/// split where the sum over both sides is smallest.
[[nodiscard]] float split_cost(const LightBounds& bounds) noexcept;

}  // namespace tetralight
