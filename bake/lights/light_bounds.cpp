// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_bounds.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

float angle_of(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

/// Replaces the cone of `a` by one that contains both cones (Conty Estevez & Kulla 2018,
/// algorithm 1).
void unite_cones(LightBounds& a, const LightBounds& b) {
    const bool a_is_wider = a.cos_theta_o <= b.cos_theta_o;
    const glm::vec3 wide_axis = a_is_wider ? a.axis : b.axis;
    const glm::vec3 narrow_axis = a_is_wider ? b.axis : a.axis;
    const float wide = angle_of(std::min(a.cos_theta_o, b.cos_theta_o));
    const float narrow = angle_of(std::max(a.cos_theta_o, b.cos_theta_o));
    const float between = angle_of(glm::dot(wide_axis, narrow_axis));
    a.cos_theta_e = std::min(a.cos_theta_e, b.cos_theta_e);
    a.axis = wide_axis;
    a.cos_theta_o = std::cos(wide);
    if (std::min(between + narrow, std::numbers::pi_v<float>) <= wide) return;
    const float half = 0.5f * (wide + between + narrow);
    const glm::vec3 side = narrow_axis - wide_axis * glm::dot(wide_axis, narrow_axis);
    const float length = glm::length(side);
    if (half >= std::numbers::pi_v<float> || length < 1e-6f) {
        a.cos_theta_o = -1.0f;
        return;
    }
    const float rotation = half - wide;
    a.axis = glm::normalize(wide_axis * std::cos(rotation) + side * (std::sin(rotation) / length));
    a.cos_theta_o = std::cos(half);
}

}  // namespace

LightBounds union_of(LightBounds a, LightBounds b) noexcept {
    if (b.power <= 0.0f) return a;
    if (a.power <= 0.0f) return b;
    // The axis of a two-sided light may be flipped: take the one that gives the narrower cone.
    if (glm::dot(a.axis, b.axis) < 0.0f) {
        if (b.is_two_sided) {
            b.axis = -b.axis;
        } else if (a.is_two_sided) {
            a.axis = -a.axis;
        }
    }
    a.is_two_sided = a.is_two_sided || b.is_two_sided;
    unite_cones(a, b);
    a.min = glm::min(a.min, b.min);
    a.max = glm::max(a.max, b.max);
    a.power += b.power;
    a.max_distance = std::max(a.max_distance, b.max_distance);
    return a;
}

float split_cost(const LightBounds& bounds) noexcept {
    const float o = angle_of(bounds.cos_theta_o);
    const float w = std::min(o + angle_of(bounds.cos_theta_e), std::numbers::pi_v<float>);
    const float directions = 2.0f * std::numbers::pi_v<float> * (1.0f - std::cos(o)) +
                             0.5f * std::numbers::pi_v<float> *
                                 (2.0f * w * std::sin(o) - std::cos(o - 2.0f * w) -
                                  2.0f * o * std::sin(o) + std::cos(o));
    const glm::vec3 d = bounds.max - bounds.min;
    return bounds.power * directions * (d.x * d.y + d.y * d.z + d.z * d.x);
}

}  // namespace tetralight
