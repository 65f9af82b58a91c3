// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// An axis-aligned box in world space.
struct Box {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    [[nodiscard]] glm::dvec3 center() const { return (low + high) * 0.5; }

    [[nodiscard]] glm::dvec3 size() const { return high - low; }

    bool operator==(const Box&) const = default;
};

/// Where a mesh's vertex stands in the world.
[[nodiscard]] glm::dvec3 world_position(const MeshInstance& instance, const glm::vec3& position);

/// Bounds of one instance; none when its mesh has no vertices.
[[nodiscard]] std::optional<Box> instance_bounds(const Scene& scene, const MeshInstance& instance);

using InstanceSelection = std::function<bool(const MeshInstance&)>;

/// Bounds of the selected instances; none when there is nothing.
[[nodiscard]] std::optional<Box> scene_bounds(const Scene& scene,
                                              const InstanceSelection& selection);

/// A good origin for floats: the centre of the selected instances' bounds. Where these are a
/// thousand times as large as the box of the vertices' middle half along each axis, something
/// stands far away, perhaps by mistake: then the median of the vertices, which it does not move.
/// The world's origin when there is nothing.
[[nodiscard]] glm::dvec3 scene_middle(const Scene& scene, const InstanceSelection& selection);

}  // namespace tetralight
