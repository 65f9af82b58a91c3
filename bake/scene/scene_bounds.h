// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/box.h>

namespace tetralight {

using WorldBox = Box<glm::dvec3>;

/// Where a mesh's vertex stands in the world.
[[nodiscard]] glm::dvec3 world_position(const MeshInstance& instance, const glm::vec3& position);

/// Bounds of one instance; none when its mesh has no vertices.
[[nodiscard]] std::optional<WorldBox> instance_bounds(const Scene& scene,
                                                      const MeshInstance& instance);

using InstanceSelection = std::function<bool(const MeshInstance&)>;

/// Bounds of the selected instances; none when there is nothing.
[[nodiscard]] std::optional<WorldBox> scene_bounds(const Scene& scene,
                                                   const InstanceSelection& selection);

/// A good origin for floats: the centre of the selected instances' bounds. Where these are a
/// thousand times as large as the box of the vertices' middle half along each axis, something
/// stands far away, perhaps by mistake: then the median of the vertices, which it does not move.
/// The world's origin when there is nothing.
[[nodiscard]] glm::dvec3 scene_center(const Scene& scene, const InstanceSelection& selection);

}  // namespace tetralight
