// SPDX-License-Identifier: Apache-2.0
#include "bake/scene/scene_bounds.h"

#include <glm/common.hpp>

namespace tetralight {
namespace {

void extend(std::optional<Box>& box, const glm::dvec3& low, const glm::dvec3& high) {
    box = box ? Box{glm::min(box->low, low), glm::max(box->high, high)} : Box{low, high};
}

}  // namespace

glm::dvec3 world_position(const MeshInstance& instance, const glm::vec3& position) {
    return glm::dvec3(instance.world_from_mesh * glm::dvec4(position, 1.0));
}

std::optional<Box> instance_bounds(const Scene& scene, const MeshInstance& instance) {
    std::optional<Box> box;
    for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
        const glm::dvec3 p = world_position(instance, position);
        extend(box, p, p);
    }
    return box;
}

std::optional<Box> scene_bounds(const Scene& scene,
                                const std::function<bool(const MeshInstance&)>& selection) {
    std::optional<Box> box;
    for (const MeshInstance& instance : scene.instances) {
        if (!selection(instance)) continue;
        if (const auto bounds = instance_bounds(scene, instance)) {
            extend(box, bounds->low, bounds->high);
        }
    }
    return box;
}

}  // namespace tetralight
