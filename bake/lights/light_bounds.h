// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <limits>

namespace tetralight {

/// Where some emitters are, where they shine to and how much: bounds of what they can send to a
/// position.
struct LightBounds {
    glm::vec3 min{0.0f};
    glm::vec3 max{0.0f};
    /// Axis of the cone that holds the emitters' own axes, a unit vector.
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    /// Cosine of that cone's half angle; −1 = shines everywhere alike.
    float cos_theta_o = -1.0f;
    /// Cosine of the angle to its own axis beyond which an emitter sends nothing.
    float cos_theta_e = -1.0f;
    /// Whether it sends the same to the other side, against its axis.
    bool is_two_sided = false;
    /// What it sends straight ahead over squared distance, any unit.
    float power = 0.0f;
    /// Distance from the box beyond which it sends nothing.
    float max_distance = std::numeric_limits<float>::infinity();

    bool operator==(const LightBounds&) const = default;
};

/// How much a colour counts as power: all channels alike.
[[nodiscard]] inline float power_of(glm::vec3 c) noexcept {
    return c.r + c.g + c.b;
}

/// Bounds of both. What has no power does not count.
[[nodiscard]] LightBounds union_of(LightBounds a, LightBounds b) noexcept;

/// How likely it is that emitters within bounds matter: how much light leaves in how many
/// directions from how large a surface (Conty Estevez & Kulla 2018, equation 1 and the paragraph
/// before it).
[[nodiscard]] float split_cost(const LightBounds& bounds) noexcept;

}  // namespace tetralight
