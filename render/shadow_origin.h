// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// Where the shadow rays of a point start, in render space. On a mesh with smooth normals it is a
/// point of the curved surface that the normals describe, above the flat triangle, so that
/// triangles which face away from a light do not cut steps into its soft edge (Hanika 2021,
/// "Hacking the Shadow Terminator").
[[nodiscard]] glm::vec3 shadow_origin(const Scene& scene, const TraceScene& traced,
                                      const Surface& surface);

}  // namespace tetralight
