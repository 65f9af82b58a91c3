// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "bake/scene/scene.h"

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

/// Bounds of the selected instances; none when there is nothing.
[[nodiscard]] std::optional<Box> scene_bounds(
    const Scene& scene, const std::function<bool(const MeshInstance&)>& selection);

}  // namespace tetralight
