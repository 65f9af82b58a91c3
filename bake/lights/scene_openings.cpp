// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/scene_openings.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include <tetralight/bake/lights/find_openings.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {
namespace {

/// Fraction of rays on one side of an opening that escape.
double openness(const TraceScene& trace_scene, const Opening& opening, glm::vec3 normal) {
    constexpr uint32_t kRays = 256;
    uint32_t escaped = 0;
    for (uint32_t i = 0; i < kRays; ++i) {
        Sampler sampler(3, i);
        const glm::vec3 origin = opening.point(sampler.next2());
        const Ray ray{origin, sample_cosine_hemisphere(normal, sampler.next2())};
        if (!trace_scene.intersect_side(ray)) ++escaped;
    }
    return static_cast<double>(escaped) / kRays;
}

Opening opening_from(const Portal& portal, const TraceScene& trace_scene) {
    Opening opening;
    opening.corner =
        trace_scene.render_from_world(portal.center - 0.5 * (portal.along + portal.across));
    opening.along = glm::vec3(portal.along);
    opening.across = glm::vec3(portal.across);
    opening.normal = glm::vec3(glm::normalize(glm::cross(portal.along, portal.across)));
    if (openness(trace_scene, opening, opening.normal) >
        openness(trace_scene, opening, -opening.normal)) {
        opening.normal = -opening.normal;
    }
    return opening;
}

/// True if two openings are about the same.
bool is_same(const Opening& a, const Opening& b) {
    const float reach = 0.25f * glm::length(a.along + a.across);
    return std::abs(glm::dot(a.normal, b.normal)) > 0.9f &&
           glm::distance(a.point(glm::vec2(0.5f)), b.point(glm::vec2(0.5f))) < reach;
}

}  // namespace

std::vector<Opening> openings_of(const Scene& scene, const TraceScene& trace_scene) {
    const bool has_sky = scene.environment.radiance != glm::vec3(0.0f);
    const bool has_sun = std::ranges::any_of(scene.lights, [](const Light& light) {
        return light.type == LightType::Directional && light.mode != LightMode::Realtime;
    });
    std::vector<Opening> openings;
    if (!has_sky && !has_sun) return openings;
    for (const Portal& portal : scene.portals) {
        openings.push_back(opening_from(portal, trace_scene));
    }
    const size_t portal_count = openings.size();
    for (const Opening& found : find_openings(trace_scene)) {
        const auto portals = std::span(openings).first(portal_count);
        if (std::ranges::none_of(portals, [&](const Opening& o) { return is_same(o, found); })) {
            openings.push_back(found);
        }
    }
    return openings;
}

}  // namespace tetralight
