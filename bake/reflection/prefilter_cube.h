// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/reflection/cube_image.h>

namespace tetralight {

/// The weight of light from an angle θ to the mirrored direction in the reflection of a GGX surface
/// of roughness √α, seen along its normal: D(θ/2) · cos θ, not normalized (Karis 2013, "Real
/// Shading in Unreal Engine 4": N = V = R). 0 beyond the horizon.
[[nodiscard]] double ggx_lobe(double cos_theta, double roughness) noexcept;

/// Blurs a cube for surfaces of one roughness: each texel of the result is the mean of the light of
/// `source` around its center by `ggx_lobe`. Distant texels, over which the lobe changes little,
/// are summed as one (quadtrees of the faces). Roughness 0 gives the mean of texels.
/// Precondition: both sizes are powers of two, `size` at most that of the source.
[[nodiscard]] CubeImage prefilter_cube(const CubeImage& source, uint32_t size, float roughness,
                                       uint32_t thread_count = 0);

/// All levels: level 0 is `cube`, level k has faces of half the size of level k - 1, blurred for
/// `roughness_of_level` (reflection/reflections.h). The number is `reflection_level_count`.
[[nodiscard]] std::vector<CubeImage> prefilter_levels(CubeImage cube, uint32_t thread_count = 0);

}  // namespace tetralight
