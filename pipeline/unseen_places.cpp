// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/unseen_places.h>

#include <tetralight/pipeline/spread_positions.h>

namespace tetralight {

UnseenPlaces find_unseen(const FreePlaces& found) {
    UnseenPlaces result;
    result.place_count = found.places.size();
    std::vector<glm::dvec3> unseen;
    for (const FreePlace& place : found.places) {
        if (place.is_unseen()) unseen.emplace_back(place.position);
    }
    result.unseen_count = unseen.size();
    for (const size_t i : spread_positions(unseen, static_cast<double>(found.spacing))) {
        result.positions.push_back(rounded_to_millimetre(unseen[i]));
    }
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
