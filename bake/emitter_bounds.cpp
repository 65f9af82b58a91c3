// SPDX-License-Identifier: Apache-2.0
#include "bake/emitter_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Rounding of a cosine; what is this near to its limit counts as within it.
constexpr float kSlack = 1e-4f;

/// Importance never falls below this share for being slanted, so that no sample weighs too much.
constexpr float kLeastCosine = 0.01f;

float sine_of(float cosine) {
    return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
}

/// cos max(0, a − b) of two angles.
float cos_difference(float cos_a, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sine_of(cos_a) * sine_of(cos_b);
}

float angle_of(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

/// A cone of directions that holds two cones (Conty Estevez & Kulla 2018, algorithm 1).
void unite_cones(EmitterBounds& a, const EmitterBounds& b) {
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

EmitterBounds united(EmitterBounds a, const EmitterBounds& b) noexcept {
    if (b.power <= 0.0f) return a;
    if (a.power <= 0.0f) return b;
    unite_cones(a, b);
    a.low = glm::min(a.low, b.low);
    a.high = glm::max(a.high, b.high);
    a.power += b.power;
    a.reach = std::max(a.reach, b.reach);
    return a;
}

float split_cost(const EmitterBounds& bounds) noexcept {
    const float o = angle_of(bounds.cos_axes);
    const float w = std::min(o + angle_of(bounds.cos_emission), kPi);
    const float directions =
        2.0f * kPi * (1.0f - std::cos(o)) + 0.5f * kPi *
                                                (2.0f * w * std::sin(o) - std::cos(o - 2.0f * w) -
                                                 2.0f * o * std::sin(o) + std::cos(o));
    const glm::vec3 d = bounds.high - bounds.low;
    return bounds.power * directions * (d.x * d.y + d.y * d.z + d.z * d.x);
}

float importance(const EmitterBounds& bounds, const Receiver& receiver) noexcept {
    const glm::vec3 nearest = glm::clamp(receiver.position, bounds.low, bounds.high);
    const glm::vec3 gap = receiver.position - nearest;
    if (glm::dot(gap, gap) > bounds.reach * bounds.reach) return 0.0f;

    const glm::vec3 half_size = 0.5f * (bounds.high - bounds.low);
    const glm::vec3 offset = receiver.position - (bounds.low + half_size);
    const float radius2 = glm::dot(half_size, half_size);
    const float distance2 = glm::dot(offset, offset);
    // Within the box any direction is possible, and distance means little.
    const float result = bounds.power / std::max({distance2, radius2, 1e-30f});
    if (distance2 <= radius2 || distance2 == 0.0f) return result;

    const glm::vec3 from_light = offset / std::sqrt(distance2);
    const float cos_box = std::sqrt(std::max(0.0f, 1.0f - radius2 / distance2));
    const float to_axes = cos_difference(glm::dot(bounds.axis, from_light), bounds.cos_axes);
    const float leaving = cos_difference(to_axes, cos_box);
    if (leaving < bounds.cos_emission - kSlack) return 0.0f;
    float arriving = 1.0f;
    if (receiver.normal != glm::vec3(0.0f)) {
        arriving = cos_difference(-glm::dot(receiver.normal, from_light), cos_box);
        if (arriving < -kSlack) return 0.0f;
    }
    return result * std::max(leaving, kLeastCosine) * std::max(arriving, kLeastCosine);
}

}  // namespace tetralight
