// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/scene_bounds.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <vector>

namespace tetralight {
namespace {

void extend(std::optional<WorldBox>& box, const WorldBox& other) {
    box = box ? union_of(*box, other) : other;
}

double largest(const glm::dvec3& size) {
    return std::max({size.x, size.y, size.z});
}

/// One coordinate of evenly chosen vertices, 65536 at most.
std::vector<double> some_coordinates(const Scene& scene, const InstanceSelection& selection,
                                     int axis) {
    constexpr uint64_t kMostVertices = 65536;
    uint64_t count = 0;
    for (const MeshInstance& instance : scene.instances) {
        if (selection(instance)) count += scene.meshes[instance.mesh].positions.size();
    }
    const uint64_t stride = (count + kMostVertices - 1) / kMostVertices;
    std::vector<double> coordinates;
    uint64_t next = 0;  // vertex to take, counted from the first one of the instance
    for (const MeshInstance& instance : scene.instances) {
        if (!selection(instance)) continue;
        const auto& positions = scene.meshes[instance.mesh].positions;
        for (; next < positions.size(); next += stride) {
            coordinates.push_back(world_position(instance, positions[next])[axis]);
        }
        next -= positions.size();
    }
    return coordinates;
}

/// Precondition: there are values.
double quantile(std::vector<double>& values, double fraction) {
    const auto rank = static_cast<ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + rank);
    return values[static_cast<size_t>(rank)];
}

}  // namespace

glm::dvec3 world_position(const MeshInstance& instance, const glm::vec3& position) {
    return glm::dvec3(instance.world_from_mesh * glm::dvec4(position, 1.0));
}

std::optional<WorldBox> instance_bounds(const Scene& scene, const MeshInstance& instance) {
    std::optional<WorldBox> box;
    for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
        const glm::dvec3 p = world_position(instance, position);
        extend(box, {p, p});
    }
    return box;
}

std::optional<WorldBox> scene_bounds(const Scene& scene, const InstanceSelection& selection) {
    std::optional<WorldBox> box;
    for (const MeshInstance& instance : scene.instances) {
        if (!selection(instance)) continue;
        if (const auto bounds = instance_bounds(scene, instance)) {
            extend(box, *bounds);
        }
    }
    return box;
}

glm::dvec3 scene_center(const Scene& scene, const InstanceSelection& selection) {
    constexpr double kWellSpread = 1000.0;
    const auto bounds = scene_bounds(scene, selection);
    if (!bounds) return glm::dvec3(0.0);
    glm::dvec3 median(0.0);
    glm::dvec3 middle_half(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values = some_coordinates(scene, selection, axis);
        const double low = quantile(values, 0.25);
        const double high = quantile(values, 0.75);
        median[axis] = quantile(values, 0.5);
        middle_half[axis] = high - low;
    }
    const bool is_well_spread = largest(bounds->size()) <= kWellSpread * largest(middle_half);
    return is_well_spread ? bounds->center() : median;
}

}  // namespace tetralight
