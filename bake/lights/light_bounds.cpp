// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_bounds.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float angle_of(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

/// A cone of directions that holds two cones (Conty Estevez & Kulla 2018, algorithm 1).
void unite_cones(LightBounds& a, const LightBounds& b) {
    const bool a_is_wider = a.cos_axes <= b.cos_axes;
    const glm::vec3 wide_axis = a_is_wider ? a.axis : b.axis;
    const glm::vec3 narrow_axis = a_is_wider ? b.axis : a.axis;
    const float wide = angle_of(std::min(a.cos_axes, b.cos_axes));
    const float narrow = angle_of(std::max(a.cos_axes, b.cos_axes));
    const float between = angle_of(glm::dot(wide_axis, narrow_axis));
    a.cos_emission = std::min(a.cos_emission, b.cos_emission);
    a.axis = wide_axis;
    a.cos_axes = std::cos(wide);
    if (std::min(between + narrow, kPi) <= wide) return;
    const float half = 0.5f * (wide + between + narrow);
    const glm::vec3 side = narrow_axis - wide_axis * glm::dot(wide_axis, narrow_axis);
    const float length = glm::length(side);
    if (half >= kPi || length < 1e-6f) {
        a.cos_axes = -1.0f;
        return;
    }
    const float turn = half - wide;
    a.axis = glm::normalize(wide_axis * std::cos(turn) + side * (std::sin(turn) / length));
    a.cos_axes = std::cos(half);
}

}  // namespace

LightBounds union_of(LightBounds a, LightBounds b) noexcept {
    if (b.power <= 0.0f) return a;
    if (a.power <= 0.0f) return b;
    // Both axes of what is two-sided are as good; together they take the narrower cone.
    if (glm::dot(a.axis, b.axis) < 0.0f) {
        if (b.is_two_sided) {
            b.axis = -b.axis;
        } else if (a.is_two_sided) {
            a.axis = -a.axis;
        }
    }
    a.is_two_sided = a.is_two_sided || b.is_two_sided;
    unite_cones(a, b);
    a.low = glm::min(a.low, b.low);
    a.high = glm::max(a.high, b.high);
    a.power += b.power;
    a.reach = std::max(a.reach, b.reach);
    return a;
}

float split_cost(const LightBounds& bounds) noexcept {
    const float o = angle_of(bounds.cos_axes);
    const float w = std::min(o + angle_of(bounds.cos_emission), kPi);
    const float directions =
        2.0f * kPi * (1.0f - std::cos(o)) + 0.5f * kPi *
                                                (2.0f * w * std::sin(o) - std::cos(o - 2.0f * w) -
                                                 2.0f * o * std::sin(o) + std::cos(o));
    const glm::vec3 d = bounds.high - bounds.low;
    return bounds.power * directions * (d.x * d.y + d.y * d.z + d.z * d.x);
}

}  // namespace tetralight
