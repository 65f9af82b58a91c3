// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/openings.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include <tetralight/bake/lights/opening_views.h>
#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {
namespace {

/// Rays by which a spot is found.
constexpr uint32_t kSpotRays = 64;

/// Distance of the sampled rectangle from an opening, towards its dark side, in its edges: light
/// that enters at a point is followed both ways from there, so that a pane in the plane of the
/// opening must be on one side of it. Not a round number, as those of panes may be.
constexpr float kPlaneOffset = 1.37e-3f;

/// The smallest radius of a spot, in edges of its opening, so that the other spots are not
/// forgotten close to it.
constexpr float kMinSpotRadius = 0.1f;

/// Openings and spots of a smaller solid angle, steradians, are not sampled: they matter little,
/// and the views from all the cubes of a landscape would be made.
constexpr float kMinSolidAngle = 1.0f / 512.0f;

/// Larger openings are met by chance.
constexpr float kMaxSolidAngle = 0.5f;

/// Distance at which a ray leaves the dark side through an opening; none if it does not.
std::optional<float> crossing(const Opening& opening, glm::vec3 origin, glm::vec3 direction) {
    const float slope = glm::dot(direction, opening.normal);
    if (slope >= 0.0f) return std::nullopt;
    const float distance = glm::dot(opening.corner - origin, opening.normal) / slope;
    if (!(distance > 0.0f)) return std::nullopt;
    const glm::vec3 offset = origin + distance * direction - opening.corner;
    const float x = glm::dot(offset, opening.along), y = glm::dot(offset, opening.across);
    const bool is_inside = x >= 0.0f && y >= 0.0f && x <= glm::dot(opening.along, opening.along) &&
                           y <= glm::dot(opening.across, opening.across);
    return is_inside ? std::optional(distance) : std::nullopt;
}

/// True if a sphere is at least in part above the surface of a shading point.
bool is_above(const ShadingPoint& shading_point, glm::vec3 offset, float radius) {
    return shading_point.normal == glm::vec3(0.0f) ||
           glm::dot(shading_point.normal, offset) + radius > 0.0f;
}

/// About the solid angle of an opening; 0 far away, close by, on its bright side and below the
/// surface.
float opening_weight(const Opening& opening, float area, const ShadingPoint& shading_point) {
    const glm::vec3 offset = opening.point(glm::vec2(0.5f)) - shading_point.position;
    if (glm::dot(opening.normal, offset) >= 0.0f) return 0.0f;
    const float radius = 0.5f * glm::length(opening.along + opening.across);
    if (!is_above(shading_point, offset, radius)) return 0.0f;
    const float solid_angle = area / (glm::dot(offset, offset) + area);
    return solid_angle > kMinSolidAngle && solid_angle < kMaxSolidAngle ? solid_angle : 0.0f;
}

/// About the light that a spot sends; 0 far away and below the surface.
float spot_weight(const LitSpot& spot, const ShadingPoint& shading_point) {
    const glm::vec3 offset = spot.center - shading_point.position;
    if (!is_above(shading_point, offset, spot.radius)) return 0.0f;
    const float distance2 = glm::dot(offset, offset), radius2 = spot.radius * spot.radius;
    if (std::numbers::pi_v<float> * radius2 < kMinSolidAngle * distance2) return 0.0f;
    return spot.power / (distance2 + radius2);
}

/// The index whose interval contains `choice` times the sum of the weights.
size_t choose(std::span<const float> weights, float sum, float choice) {
    float rest = choice * sum;
    size_t last = 0;  // the last positive one, if rounding passes them all
    for (size_t i = 0; i < weights.size(); ++i) {
        if (!(weights[i] > 0.0f)) continue;
        last = i;
        if (rest < weights[i]) break;
        rest -= weights[i];
    }
    return last;
}

}  // namespace

float Opening::area() const noexcept {
    return glm::length(along) * glm::length(across);
}

Openings::Openings() = default;
Openings::~Openings() = default;
Openings::Openings(Openings&&) noexcept = default;
Openings& Openings::operator=(Openings&&) noexcept = default;

Openings::Openings(const TraceScene& trace_scene, std::vector<Opening> openings,
                   std::vector<Light> lights)
    : trace_scene_(&trace_scene), openings_(std::move(openings)), lights_(std::move(lights)) {
    if (openings_.size() > kMaxCount) openings_.resize(kMaxCount);
    if (openings_.empty()) return;
    for (Opening& opening : openings_) {
        areas_.push_back(opening.area());
        opening.corner += kPlaneOffset * std::sqrt(opening.area()) * opening.normal;
    }
    for (uint32_t i = 0; i < openings_.size(); ++i) {
        for (uint32_t k = 0; k < lights_.size(); ++k) find_spot(i, k);
    }
    std::ranges::stable_sort(spots_, std::ranges::greater{}, &LitSpot::power);
    if (spots_.size() > kMaxCount) spots_.resize(kMaxCount);
    views_ = std::make_unique<OpeningViews>(trace_scene, openings_, spots_, lights_);
}

void Openings::find_spot(uint32_t opening, uint32_t light) {
    LitSpot spot{opening, light};
    std::vector<glm::vec3> points;
    for (uint32_t i = 0; i < kSpotRays; ++i) {
        const glm::vec3 entrance = openings_[opening].point(owen_sobol2(i, opening));
        const LightSample sample =
            sample_light(lights_[light], entrance, owen_sobol2(i, ~uint64_t{opening}));
        const float slope = -glm::dot(sample.to_light, openings_[opening].normal);
        if (slope <= 0.0f || trace_scene_->occluded({entrance, sample.to_light})) continue;
        const auto surface =
            trace_scene_->intersect({entrance, -sample.to_light}, TraceScene::Detail::LightOnly,
                                    TraceScene::kDiffuseSpread);
        if (!surface || surface->is_back_face) continue;
        points.push_back(surface->position);
        spot.power += slope * power_of(sample.irradiance * surface->albedo);
    }
    if (!(spot.power > 0.0f)) return;
    spot.power *= areas_[opening] / kSpotRays;
    for (const glm::vec3& point : points) {
        spot.center += point / static_cast<float>(points.size());
    }
    spot.radius = kMinSpotRadius * std::sqrt(areas_[opening]);
    for (const glm::vec3& point : points) {
        spot.radius = std::max(spot.radius, glm::distance(point, spot.center));
    }
    spots_.push_back(spot);
}

Openings::Weights Openings::weights(const ShadingPoint& shading_point) const {
    Weights weights;
    bool is_near = false;
    for (size_t i = 0; i < openings_.size(); ++i) {
        weights.openings[i] = opening_weight(openings_[i], areas_[i], shading_point);
        is_near = is_near || weights.openings[i] > 0.0f;
    }
    for (size_t i = 0; i < spots_.size(); ++i) {
        weights.spots[i] = spot_weight(spots_[i], shading_point);
        is_near = is_near || weights.spots[i] > 0.0f;
    }
    if (!is_near) return weights;
    const OpeningViews::View& view = views_->view_from(shading_point);
    for (size_t i = 0; i < openings_.size(); ++i) {
        weights.openings[i] *= view.openings[i];
        weights.opening_sum += weights.openings[i];
    }
    for (size_t i = 0; i < spots_.size(); ++i) {
        weights.spots[i] *= view.spots[i];
        weights.spot_sum += weights.spots[i];
    }
    return weights;
}

glm::vec3 Openings::sample_direction(const Weights& weights, glm::vec3 position, float choice,
                                     glm::vec2 u) const noexcept {
    const auto all = std::span(weights.openings).first(openings_.size());
    const Opening& opening = openings_[choose(all, weights.opening_sum, choice)];
    return glm::normalize(opening.point(u) - position);
}

float Openings::direction_pdf(const Weights& weights, glm::vec3 position,
                              glm::vec3 direction) const noexcept {
    float sum = 0.0f;
    for (size_t i = 0; i < openings_.size(); ++i) {
        if (!(weights.openings[i] > 0.0f)) continue;
        const auto distance = crossing(openings_[i], position, direction);
        if (!distance) continue;
        const float slope = -glm::dot(direction, openings_[i].normal);
        sum += weights.openings[i] * *distance * *distance / (areas_[i] * slope);
    }
    return sum > 0.0f ? sum / weights.opening_sum : 0.0f;
}

Openings::Entrance Openings::sample_entrance(const Weights& weights, float choice,
                                             glm::vec2 u) const noexcept {
    const auto all = std::span(weights.spots).first(spots_.size());
    const LitSpot& spot = spots_[choose(all, weights.spot_sum, choice)];
    return {spot.light, openings_[spot.opening].point(u)};
}

float Openings::entrance_density(const Weights& weights, uint32_t light, glm::vec3 position,
                                 glm::vec3 to_light) const noexcept {
    float sum = 0.0f;
    for (size_t i = 0; i < spots_.size(); ++i) {
        if (spots_[i].light != light || !(weights.spots[i] > 0.0f)) continue;
        const uint32_t opening = spots_[i].opening;
        if (!crossing(openings_[opening], position, to_light)) continue;
        // Area across the light is area of the opening times the cosine.
        const float slope = -glm::dot(to_light, openings_[opening].normal);
        sum += weights.spots[i] / (areas_[opening] * slope);
    }
    return sum > 0.0f ? sum / weights.spot_sum : 0.0f;
}

}  // namespace tetralight
