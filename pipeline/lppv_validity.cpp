// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lppv_validity.h>

#include <tetralight/bake/probe_visibility.h>

namespace tetralight {

Result<std::vector<float>> lppv_grid_validity(const Scene& scene, const LppvGrid& grid,
                                              uint32_t thread_count) {
    std::vector<glm::dvec3> positions;
    positions.reserve(grid.point_count());
    for (uint32_t z = 0; z < grid.resolution.z; ++z) {
        for (uint32_t y = 0; y < grid.resolution.y; ++y) {
            for (uint32_t x = 0; x < grid.resolution.x; ++x) {
                positions.push_back(grid.world_position({x, y, z}));
            }
        }
    }
    const auto visibility = probe_visibilities(scene, positions, thread_count);
    if (!visibility) return visibility.error();
    std::vector<float> validity;
    validity.reserve(visibility->size());
    for (const ProbeVisibility& at_point : *visibility) {
        validity.push_back(at_point.is_inside() ? 0.0f : 1.0f - at_point.back_face_fraction);
    }
    return validity;
}

}  // namespace tetralight
