// SPDX-License-Identifier: Apache-2.0
#include "bake/survey.h"

#include <glm/geometric.hpp>

#include "bake/parallel.h"
#include "bake/sampling.h"

namespace tetralight {

std::span<const glm::vec3> survey_directions() {
    constexpr uint32_t kDirectionCount = 64;
    static const std::vector<glm::vec3> directions = spherical_fibonacci(kDirectionCount);
    return directions;
}

Surroundings look_around(const TraceScene& traced, glm::vec3 position) {
    uint32_t back_faces = 0;
    uint32_t behind = 0;
    uint32_t escaped = 0;
    for (const glm::vec3& direction : survey_directions()) {
        const auto side = traced.cast_side({position, direction});
        escaped += !side;
        back_faces += side && side->is_back_face;
        behind += side && side->is_from_behind;
    }
    const auto count = static_cast<float>(survey_directions().size());
    Surroundings result{.back_face_share = static_cast<float>(back_faces) / count,
                        .behind_share = static_cast<float>(behind) / count,
                        .escape_share = static_cast<float>(escaped) / count};
    if (const auto nearest = traced.nearest_surface(position)) {
        result.surface_distance = glm::distance(position, *nearest);
    }
    return result;
}

Result<std::vector<Surroundings>> survey(const Scene& scene, std::span<const glm::dvec3> positions,
                                         uint32_t thread_count) {
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    std::vector<Surroundings> result(positions.size());
    parallel_for(positions.size(), thread_count, [&](size_t i) {
        result[i] = look_around(*traced, traced->traced_from_world(positions[i]));
    });
    return result;
}

}  // namespace tetralight
