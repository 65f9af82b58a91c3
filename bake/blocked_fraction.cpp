// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/blocked_fraction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace tetralight {
namespace {

constexpr float kNearest = 1e-4f;
constexpr float kLeastTransmittance = 0.5f;
/// More surfaces on one ray are not looked at: a bound of the time, not of the answer.
constexpr int kMostCrossings = 256;

/// A surface on a ray, and the fraction of the ray's light that it stops.
struct Loss {
    float distance = 0.0f;
    float loss = 0.0f;
};

/// Calls `add(loss)` for each surface until a ray has lost nearly all of its light or `add` returns
/// false.
template <class Add>
void for_each_loss(const TraceScene& trace_scene, glm::vec3 from, glm::vec3 to, Add&& add) {
    Ray ray{from, to - from, 1.0f, kNearest};
    float transmittance = 1.0f;
    for (int i = 0; i < kMostCrossings && transmittance > 0.01f; ++i) {
        const auto crossing = trace_scene.nearest_crossing(ray);
        if (!crossing) return;
        const float loss = transmittance * crossing->opacity;
        transmittance -= loss;
        if (loss > 0.0f && !add(Loss{crossing->distance, loss})) return;
        ray.min_distance = std::nextafter(crossing->distance, 2.0f);
        if (!(ray.min_distance < ray.max_distance)) return;
    }
}

/// Two vectors across a direction, turned so that they lie in no plane of usual buildings.
std::array<glm::vec3, 2> across(glm::vec3 direction) {
    const glm::vec3 unit = glm::normalize(direction);
    const glm::vec3 other =
        std::abs(unit.y) < 0.8f ? glm::vec3(0.31f, 0.86f, 0.41f) : glm::vec3(0.86f, 0.31f, 0.41f);
    const glm::vec3 first = glm::normalize(glm::cross(unit, other));
    return {first, glm::cross(unit, first)};
}

}  // namespace

std::optional<float> blocked_fraction(const TraceScene& trace_scene, glm::vec3 from, glm::vec3 to) {
    std::optional<float> fraction;
    float lost = 0.0f;
    for_each_loss(trace_scene, from, to, [&](const Loss& loss) {
        lost += loss.loss;
        if (lost >= kLeastTransmittance) fraction = loss.distance;
        return !fraction;
    });
    return fraction;
}

std::optional<float> blocked_fraction_of_pencil(const TraceScene& trace_scene, glm::vec3 from,
                                                glm::vec3 to) {
    constexpr float kRadius = 0.01f;
    constexpr int kRays = 5;
    const auto [u, v] = across(to - from);
    const float radius = kRadius * glm::distance(from, to);
    const std::array<glm::vec3, kRays> offsets{glm::vec3(0.0f), u, -u, v, -v};
    std::vector<Loss> losses;
    int free_count = 0;
    for (const glm::vec3& offset : offsets) {
        const size_t before = losses.size();
        for_each_loss(trace_scene, from, to + radius * offset, [&](const Loss& loss) {
            losses.push_back(loss);
            return true;
        });
        free_count += losses.size() == before;
        if (2 * free_count > kRays) return std::nullopt;
    }
    std::ranges::stable_sort(losses, {}, &Loss::distance);
    float lost = 0.0f;
    for (const Loss& loss : losses) {
        lost += loss.loss / static_cast<float>(kRays);
        if (lost >= kLeastTransmittance) return loss.distance;
    }
    return std::nullopt;
}

}  // namespace tetralight
