// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/box.h>

namespace tetralight {

using WorldBox = Box<glm::dvec3>;

/// World position of a mesh's vertex.
[[nodiscard]] glm::dvec3 world_position(const MeshInstance& instance, const glm::vec3& position);

/// Bounds of one instance; empty if its mesh has no vertices.
[[nodiscard]] std::optional<WorldBox> instance_bounds(const Scene& scene,
                                                      const MeshInstance& instance);

using InstanceSelection = std::function<bool(const MeshInstance&)>;

/// Bounds of the selected instances; empty if there are none.
[[nodiscard]] std::optional<WorldBox> scene_bounds(const Scene& scene,
                                                   const InstanceSelection& selection);

/// An origin for float coordinates: the centre of the selected instances' bounds. If the bounds are
/// more than 1000 times as large as the box of the vertices' interquartile ranges, the scene has
/// outliers: then the median of the vertices, which outliers do not change. The world's origin if
/// no instance is selected.
[[nodiscard]] glm::dvec3 scene_center(const Scene& scene, const InstanceSelection& selection);

}  // namespace tetralight
