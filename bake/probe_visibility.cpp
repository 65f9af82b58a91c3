// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_visibility.h>

#include <glm/geometric.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/sampling/sampling.h>

namespace tetralight {

std::span<const glm::vec3> probe_visibility_directions() {
    constexpr uint32_t kDirectionCount = 64;
    static const std::vector<glm::vec3> directions = spherical_fibonacci(kDirectionCount);
    return directions;
}

ProbeVisibility probe_visibility(const TraceScene& trace_scene, glm::vec3 position) {
    uint32_t back_faces = 0;
    uint32_t behind = 0;
    uint32_t escaped = 0;
    for (const glm::vec3& direction : probe_visibility_directions()) {
        const auto side = trace_scene.intersect_side({position, direction});
        escaped += !side;
        back_faces += side && side->is_back_face;
        behind += side && side->is_from_behind;
    }
    const auto count = static_cast<float>(probe_visibility_directions().size());
    ProbeVisibility result{.back_face_fraction = static_cast<float>(back_faces) / count,
                           .behind_fraction = static_cast<float>(behind) / count,
                           .escape_fraction = static_cast<float>(escaped) / count};
    if (const auto nearest = trace_scene.nearest_surface(position)) {
        result.surface_distance = glm::distance(position, *nearest);
    }
    return result;
}

Result<std::vector<ProbeVisibility>> probe_visibilities(const Scene& scene,
                                                        std::span<const glm::dvec3> positions,
                                                        uint32_t thread_count) {
    const auto trace_scene = TraceScene::make_static(scene);
    if (!trace_scene) return trace_scene.error();
    std::vector<ProbeVisibility> result(positions.size());
    parallel_for(positions.size(), thread_count, [&](size_t i) {
        result[i] = probe_visibility(*trace_scene, trace_scene->render_from_world(positions[i]));
    });
    return result;
}

}  // namespace tetralight
