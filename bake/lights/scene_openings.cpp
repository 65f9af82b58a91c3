// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/scene_openings.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>

#include <tetralight/bake/lights/find_openings.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {
namespace {

/// Fraction of rays on one side of an opening that escape.
float openness(const TraceScene& trace_scene, const Opening& opening, glm::vec3 normal) {
    constexpr uint32_t kRays = 256;
    uint32_t escaped = 0;
    for (uint32_t i = 0; i < kRays; ++i) {
        Sampler sampler(3, i);
        const glm::vec3 origin = opening.point(sampler.next2());
        const Ray ray{origin, sample_cosine_hemisphere(normal, sampler.next2())};
        if (!trace_scene.intersect_side(ray)) ++escaped;
    }
    return static_cast<float>(escaped) / kRays;
}

/// About the light that an opening lets in.
struct Candidate {
    Opening opening;
    float light = 0.0f;
};

/// The opening, turned towards its darker side; none if that is hardly darker.
std::optional<Candidate> candidate_from(const TraceScene& trace_scene, Opening opening) {
    float dark = openness(trace_scene, opening, opening.normal);
    float bright = openness(trace_scene, opening, -opening.normal);
    if (dark > bright) {
        std::swap(dark, bright);
        opening.normal = -opening.normal;
    }
    if (!(2.0f * dark < bright)) return std::nullopt;
    return Candidate{opening, opening.area() * (bright - dark)};
}

Opening opening_from(const Portal& portal, const TraceScene& trace_scene) {
    return {trace_scene.render_from_world(portal.center - 0.5 * (portal.along + portal.across)),
            glm::vec3(portal.along), glm::vec3(portal.across),
            glm::vec3(glm::normalize(glm::cross(portal.along, portal.across)))};
}

/// True if two openings are about the same.
bool is_same(const Opening& a, const Opening& b) {
    const float reach = 0.25f * glm::length(a.along + a.across);
    const float ratio = a.area() / b.area();
    return ratio > 0.5f && ratio < 2.0f && std::abs(glm::dot(a.normal, b.normal)) > 0.9f &&
           glm::distance(a.point(glm::vec2(0.5f)), b.point(glm::vec2(0.5f))) < reach;
}

}  // namespace

std::vector<Opening> openings_of(const Scene& scene, const TraceScene& trace_scene) {
    const bool has_sky = scene.environment.radiance != glm::vec3(0.0f);
    const bool has_sun = std::ranges::any_of(scene.lights, [](const Light& light) {
        return light.type == LightType::Directional && light.mode != LightMode::Realtime;
    });
    if (!has_sky && !has_sun) return {};
    std::vector<Candidate> candidates;
    const auto add = [&](const Opening& opening) {
        if (const auto candidate = candidate_from(trace_scene, opening))
            candidates.push_back(*candidate);
    };
    for (const Portal& portal : scene.portals) add(opening_from(portal, trace_scene));
    const size_t portal_count = candidates.size();
    for (const Opening& found : find_openings(trace_scene)) {
        const auto portals = std::span(candidates).first(portal_count);
        const auto is_found = [&](const Candidate& c) { return is_same(c.opening, found); };
        if (std::ranges::none_of(portals, is_found)) add(found);
    }
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::light);
    if (candidates.size() > Openings::kMaxCount) candidates.resize(Openings::kMaxCount);
    std::vector<Opening> openings;
    for (const Candidate& candidate : candidates) openings.push_back(candidate.opening);
    return openings;
}

}  // namespace tetralight
