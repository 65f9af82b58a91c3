// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/sensors.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/parallel.h>

namespace tetralight {
namespace {

/// Number i of the sequence along dimension d of four: fractions of i / φ^(d+1), where φ is the
/// root of x⁵ = x + 1.
double fraction(uint64_t i, int d) {
    constexpr double kPhi = 1.1673039782614187;
    const double step = std::pow(1.0 / kPhi, d + 1);
    const double x = 0.5 + static_cast<double>(i + 1) * step;
    return x - std::floor(x);
}

}  // namespace

SensorSequence::SensorSequence(const TraceScene& traced, const WorldBox& bounds,
                               double surface_offset, Filter is_free)
    : traced_(traced),
      bounds_(bounds),
      surface_offset_(surface_offset),
      is_free_(std::move(is_free)) {
    double sum = 0.0;
    for (uint32_t g = 0; g < traced.geometry_count(); ++g) {
        for (uint32_t p = 0; p < traced.triangle_count(g); ++p) {
            const auto [a, b, c] = traced.triangle(g, p);
            const glm::dvec3 center = traced.world_from_render((a + b + c) / 3.0f);
            if (!contains(bounds, center)) continue;
            sum += 0.5 * double{glm::length(glm::cross(b - a, c - a))};
            triangles_.push_back({g, p});
            area_sums_.push_back(sum);
        }
    }
}

glm::dvec3 SensorSequence::in_bounds(uint64_t i) const {
    return bounds_.min +
           bounds_.size() * glm::dvec3(fraction(i, 0), fraction(i, 1), fraction(i, 2));
}

glm::dvec3 SensorSequence::off_a_surface(uint64_t i) const {
    const double wanted = fraction(i, 0) * area_sums_.back();
    const size_t found = std::ranges::upper_bound(area_sums_, wanted) - area_sums_.begin();
    const Triangle& chosen = triangles_[std::min(found, triangles_.size() - 1)];
    const auto [a, b, c] = traced_.triangle(chosen.geometry, chosen.primitive);
    const auto root = static_cast<float>(std::sqrt(fraction(i, 1)));
    const auto v = static_cast<float>(fraction(i, 2));
    const glm::vec3 place = a + root * (1.0f - v) * (b - a) + root * v * (c - a);
    glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const bool is_back = traced_.is_double_sided(chosen.geometry) && fraction(i, 3) < 0.5;
    if (is_back) normal = -normal;
    return traced_.world_from_render(place) + surface_offset_ * glm::dvec3(normal);
}

bool SensorSequence::is_usable(const glm::dvec3& position) const {
    const bool is_number = position == position;  // triangles without area have no normal
    return is_number && contains(bounds_, position) && is_free_(position);
}

std::vector<glm::dvec3> SensorSequence::next(size_t count, uint32_t thread_count) {
    constexpr size_t kMaxTries = 64;
    std::vector<glm::dvec3> places;
    for (size_t tries = 0; places.size() < count && tries < kMaxTries; ++tries) {
        std::vector<glm::dvec3> some(count);
        std::vector<uint8_t> is_fine(count, 0);
        parallel_for(count, thread_count, [&](size_t k) {
            const uint64_t i = tried_ + k;
            some[k] = i % 2 == 0 || triangles_.empty() ? in_bounds(i) : off_a_surface(i);
            is_fine[k] = is_usable(some[k]);
        });
        for (size_t k = 0; k < count && places.size() < count; ++k) {
            ++tried_;
            if (is_fine[k] != 0) places.push_back(some[k]);
        }
    }
    return places;
}

}  // namespace tetralight
