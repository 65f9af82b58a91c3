// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/opening_views.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {
namespace {

/// Rays from a cube to each opening and spot.
constexpr uint32_t kRayCount = 16;

constexpr size_t kBucketCount = 1u << 14;

}  // namespace

OpeningViews::OpeningViews(const TraceScene& trace_scene, std::span<const Opening> openings,
                           std::span<const LitSpot> spots, std::span<const Light> lights)
    : trace_scene_(trace_scene),
      openings_(openings),
      spots_(spots),
      lights_(lights),
      buckets_(kBucketCount) {
    for (const Opening& opening : openings) {
        cube_size_ += std::sqrt(opening.area()) / static_cast<float>(openings.size());
    }
}

OpeningViews::~OpeningViews() {
    for (auto& bucket : buckets_) {
        for (const Entry* entry = bucket.load(); entry != nullptr;) {
            const std::unique_ptr<const Entry> owned(entry);
            entry = entry->next;
        }
    }
}

const OpeningViews::View& OpeningViews::view_from(const ShadingPoint& shading_point) const {
    const glm::vec3 position = shading_point.position + 0.5f * cube_size_ * shading_point.normal;
    const glm::ivec3 cube(glm::clamp(glm::floor(position / cube_size_), -1e9f, 1e9f));
    auto& bucket = buckets_[probe_key(0, glm::dvec3(cube)) % kBucketCount];
    const auto find = [&](const Entry* entry, const Entry* end) {
        while (entry != end && entry->cube != cube) entry = entry->next;
        return entry == end ? nullptr : entry;
    };
    const Entry* first = bucket.load(std::memory_order_acquire);
    if (const Entry* found = find(first, nullptr)) return found->view;
    auto made = std::make_unique<Entry>(Entry{cube, look_from(cube), first});
    while (!bucket.compare_exchange_weak(made->next, made.get(), std::memory_order_acq_rel,
                                         std::memory_order_acquire)) {
        // Other threads have added entries, perhaps this one: then theirs is the same.
        if (const Entry* found = find(made->next, first)) return found->view;
    }
    return made.release()->view;
}

OpeningViews::View OpeningViews::look_from(const glm::ivec3& cube) const {
    View view;
    for (uint32_t i = 0; i < kRayCount; ++i) {
        Sampler sampler(probe_key(1, glm::dvec3(cube)), i);
        const glm::vec2 xy = sampler.next2();
        const glm::vec3 from = (glm::vec3(cube) + glm::vec3(xy, sampler.next())) * cube_size_;
        for (size_t k = 0; k < openings_.size(); ++k) {
            if (sees_opening(openings_[k], from, sampler.next2())) view.openings[k] += 1.0f;
        }
        for (size_t k = 0; k < spots_.size(); ++k) {
            const glm::vec2 u = sampler.next2();
            if (sees_spot(spots_[k], from, u, sampler.next2())) view.spots[k] += 1.0f;
        }
    }
    for (size_t k = 0; k < Openings::kMaxCount; ++k) {
        view.openings[k] = std::sqrt(view.openings[k] / kRayCount);
        view.spots[k] = std::sqrt(view.spots[k] / kRayCount);
    }
    return view;
}

bool OpeningViews::sees_opening(const Opening& opening, glm::vec3 from, glm::vec2 u) const {
    const glm::vec3 offset = opening.point(u) - from;
    return glm::dot(offset, opening.normal) < 0.0f && !trace_scene_.occluded({from, offset, 1.0f});
}

bool OpeningViews::sees_spot(const LitSpot& spot, glm::vec3 from, glm::vec2 u,
                             glm::vec2 light_u) const {
    const glm::vec3 entrance = openings_[spot.opening].point(u);
    const LightSample sample = sample_light(lights_[spot.light], entrance, light_u);
    const auto surface =
        trace_scene_.intersect({entrance, -sample.to_light}, TraceScene::Detail::LightOnly);
    if (!surface || surface->is_back_face) return false;
    const glm::vec3 offset = TraceScene::ray_origin(*surface, surface->geometric_normal) - from;
    return glm::dot(offset, surface->geometric_normal) < 0.0f &&
           !trace_scene_.occluded({from, offset, 1.0f});
}

}  // namespace tetralight
