// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/emissive_triangles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {
namespace {

/// Texture lookups per triangle, if its emission varies.
constexpr uint32_t kLookups = 32;

/// Weights of the second and third corner, uniform by area (Heitz 2019, "A Low-Distortion Map
/// Between Triangle and Square").
glm::vec2 sample_triangle(glm::vec2 u) {
    if (u.y > u.x) {
        const float x = 0.5f * u.x;
        return {x, u.y - x};
    }
    const float y = 0.5f * u.y;
    return {u.x - y, y};
}

float mean_emission(const TraceScene& trace_scene, uint32_t geometry, uint32_t primitive) {
    const uint32_t count = trace_scene.has_varied_emission(geometry) ? kLookups : 1;
    double sum = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec2 point = sample_triangle(owen_sobol2(i, primitive));
        sum += power_of(trace_scene.visible_emission(geometry, primitive, point));
    }
    return static_cast<float>(sum / count);
}

}  // namespace

EmissiveTriangles::EmissiveTriangles(const TraceScene& trace_scene)
    : trace_scene_(trace_scene), first_of_geometry_(trace_scene.geometry_count(), kNoIndex) {
    std::vector<LightBounds> bounds;
    for (uint32_t geometry = 0; geometry < trace_scene.geometry_count(); ++geometry) {
        if (!trace_scene.can_emit(geometry)) continue;
        first_of_geometry_[geometry] = static_cast<uint32_t>(triangles_.size());
        const uint32_t count = trace_scene.triangle_count(geometry);
        for (uint32_t primitive = 0; primitive < count; ++primitive) {
            add(geometry, primitive, bounds);
        }
    }
    tree_ = LightTree(bounds);
}

void EmissiveTriangles::add(uint32_t geometry, uint32_t primitive,
                            std::vector<LightBounds>& bounds) {
    const std::array<glm::vec3, 3> corners = trace_scene_.triangle(geometry, primitive);
    const glm::vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const glm::vec3 area_vector = 0.5f * glm::cross(u, v);
    const float area = glm::length(area_vector);
    triangles_.push_back({corners[0], {u, v}, geometry, primitive});
    LightBounds& light_bounds = bounds.emplace_back();
    light_bounds.min = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    light_bounds.max = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    if (!(area > 0.0f) || !std::isfinite(area)) return;
    light_bounds.power = area * mean_emission(trace_scene_, geometry, primitive);
    light_bounds.is_two_sided = trace_scene_.is_double_sided(geometry);
    light_bounds.axis = area_vector / area;
    light_bounds.cos_theta_o = 1.0f;
    light_bounds.cos_theta_e = 0.0f;
}

LightSample EmissiveTriangles::sample(const ShadingPoint& shading_point, double choice,
                                      glm::vec2 u) const noexcept {
    const auto chosen = tree_.sample(shading_point, choice);
    if (!chosen) return {};
    const Triangle& triangle = triangles_[chosen->light];
    const glm::vec2 weights = sample_triangle(u);
    const glm::vec3 point =
        triangle.corner + weights.x * triangle.edges[0] + weights.y * triangle.edges[1];
    const glm::vec3 offset = point - shading_point.position;
    const float distance = glm::length(offset);
    if (!(distance > 0.0f)) return {};

    glm::vec3 area_vector = 0.5f * glm::cross(triangle.edges[0], triangle.edges[1]);
    LightSample sample;
    sample.to_light = offset / distance;
    float facing_area = -glm::dot(area_vector, sample.to_light);  // area times cosine
    if (facing_area < 0.0f && trace_scene_.is_double_sided(triangle.geometry)) {
        facing_area = -facing_area;
        area_vector = -area_vector;
    }
    if (!(facing_area > 0.0f)) return {};
    sample.pdf = chosen->probability * distance * distance / facing_area;
    sample.irradiance =
        trace_scene_.visible_emission(triangle.geometry, triangle.primitive, weights) / sample.pdf;
    // Ends in front of the triangle, so that the shadow ray does not hit the triangle itself.
    sample.target =
        TraceScene::shadow_target({{triangle.corner, triangle.corner + triangle.edges[0],
                                    triangle.corner + triangle.edges[1]},
                                   point,
                                   glm::normalize(area_vector)},
                                  shading_point.position);
    sample.source = triangle.geometry;
    return sample;
}

float EmissiveTriangles::pdf(const ShadingPoint& shading_point,
                             const Surface& surface) const noexcept {
    const uint32_t first = first_of_geometry_[surface.geometry];
    if (first == kNoIndex) return 0.0f;
    const Triangle& triangle = triangles_[first + surface.primitive];
    const glm::vec3 offset = surface.position - shading_point.position;
    const float distance2 = glm::dot(offset, offset);
    const glm::vec3 area_vector = 0.5f * glm::cross(triangle.edges[0], triangle.edges[1]);
    const float facing_area = std::abs(glm::dot(area_vector, offset)) / std::sqrt(distance2);
    if (!(facing_area > 0.0f)) return 0.0f;
    return tree_.probability(shading_point, first + surface.primitive) * distance2 / facing_area;
}

}  // namespace tetralight
