// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/unseen_places.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight {
namespace {

constexpr size_t kMostShown = 8;

size_t nearest_to_mean(const std::vector<glm::dvec3>& positions) {
    glm::dvec3 mean(0.0);
    for (const glm::dvec3& position : positions) mean += position;
    mean /= static_cast<double>(positions.size());
    const auto nearest = std::ranges::min_element(
        positions, {}, [&](const glm::dvec3& position) { return glm::distance(position, mean); });
    return static_cast<size_t>(nearest - positions.begin());
}

/// Positions that are spread out over all of them.
std::vector<glm::dvec3> spread_out(const std::vector<glm::dvec3>& positions, double spacing) {
    std::vector<glm::dvec3> chosen;
    if (positions.empty()) return chosen;
    std::vector<double> distances(positions.size(), std::numeric_limits<double>::infinity());
    size_t next = nearest_to_mean(positions);
    do {
        chosen.push_back(glm::round(positions[next] * 1000.0) / 1000.0 + 0.0);  // no -0
        for (size_t i = 0; i < positions.size(); ++i) {
            distances[i] = std::min(distances[i], glm::distance(positions[i], positions[next]));
        }
        next = static_cast<size_t>(std::ranges::max_element(distances) - distances.begin());
    } while (chosen.size() < kMostShown && distances[next] > spacing);
    return chosen;
}

}  // namespace

UnseenPlaces find_unseen(const FreePlaces& found) {
    UnseenPlaces result;
    result.place_count = found.places.size();
    std::vector<glm::dvec3> unseen;
    for (const FreePlace& place : found.places) {
        if (place.is_unseen()) unseen.emplace_back(place.position);
    }
    result.unseen_count = unseen.size();
    result.positions = spread_out(unseen, static_cast<double>(found.spacing));
    return result;
}

Result<UnseenPlaces> measure_unseen(const Scene& scene, const ProbeVolumeView& volume,
                                    float min_validity, uint32_t thread_count) {
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    const ProbeEyes eyes = make_probe_eyes(*traced, volume, min_validity, thread_count);
    return find_unseen(find_free_places(
        *traced, eyes, volume,
        {.count = kUnseenPlaceCount, .min_validity = min_validity, .thread_count = thread_count}));
}

}  // namespace tetralight
