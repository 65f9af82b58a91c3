// SPDX-License-Identifier: Apache-2.0
#include "bake/survey.h"

#include "bake/parallel.h"
#include "bake/sampling.h"
#include "bake/trace_scene.h"

namespace tetralight {
namespace {

constexpr uint32_t kDirectionCount = 64;

Surroundings look_around(const TraceScene& traced, glm::vec3 origin,
                         std::span<const glm::vec3> directions) {
    uint32_t back_faces = 0;
    uint32_t behind = 0;
    for (const glm::vec3& direction : directions) {
        const auto surface = traced.cast({origin, direction});
        if (!surface) continue;
        back_faces += surface->is_back_face;
        behind += surface->is_from_behind;
    }
    return {static_cast<float>(back_faces) / kDirectionCount,
            static_cast<float>(behind) / kDirectionCount};
}

}  // namespace

Result<std::vector<Surroundings>> survey(const Scene& scene, std::span<const glm::dvec3> positions,
                                         uint32_t thread_count) {
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    const std::vector<glm::vec3> directions = spherical_fibonacci(kDirectionCount);
    std::vector<Surroundings> result(positions.size());
    parallel_for(positions.size(), thread_count, [&](size_t i) {
        result[i] = look_around(*traced, traced->traced_from_world(positions[i]), directions);
    });
    return result;
}

}  // namespace tetralight
