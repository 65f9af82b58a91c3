// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// A unit sphere of 20 · 4^subdivisions triangles: a subdivided icosahedron with normals.
[[nodiscard]] Mesh make_sphere_mesh(uint32_t subdivisions);

}  // namespace tetralight
