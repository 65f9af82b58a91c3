// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lppv_validity.h>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_visibility.h>

namespace tetralight {

std::vector<float> lppv_grid_validity(const TraceScene& traced, const LppvGrid& grid,
                                      uint32_t thread_count) {
    std::vector<float> validity(grid.point_count());
    parallel_for(validity.size(), thread_count, [&](size_t i) {
        const glm::dvec3 position = grid.world_position(grid.point(i));
        const auto at_point = probe_visibility(traced, traced.render_from_world(position));
        validity[i] = at_point.is_inside() ? 0.0f : 1.0f - at_point.back_face_fraction;
    });
    return validity;
}

Result<std::vector<float>> lppv_grid_validity(const Scene& scene, const LppvGrid& grid,
                                              uint32_t thread_count) {
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    return lppv_grid_validity(*traced, grid, thread_count);
}

}  // namespace tetralight
