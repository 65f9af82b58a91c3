// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <tetralight/bake/image/image.h>
#include <tetralight/reflection/reflections.h>

// Cubes of reflection probes as images for other programs: radiance in the units of the lights.

namespace tetralight {

/// One face of a cube, 0 to 5: +X, -X, +Y, -Y, +Z, -Z. Preconditions: probe and level exist.
[[nodiscard]] ImageF face_image(const ReflectionsView& reflections, size_t probe, uint32_t level,
                                uint32_t face);

/// The six faces of a cube in their order, the first on top. Preconditions: probe and level exist.
[[nodiscard]] ImageF cube_strip(const ReflectionsView& reflections, size_t probe, uint32_t level);

}  // namespace tetralight
