// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <tetralight/bake/image/image.h>
#include <tetralight/reflection/reflections.h>

// Cubes of reflection probes as images for other programs: radiance in the units of the lights.

namespace tetralight {

/// The six faces of a cube, one below the other: +X, -X, +Y, -Y, +Z, -Z. Preconditions: probe and
/// level exist.
[[nodiscard]] ImageF cube_strip(const ReflectionsView& reflections, size_t probe, uint32_t level);

}  // namespace tetralight
