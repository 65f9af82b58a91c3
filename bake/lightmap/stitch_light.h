// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/stitch_seams.h>
#include <tetralight/bake/texel_light.h>

namespace tetralight {

/// Stitches the light of the texels at seams: each value of `total` and of each of `layers`, which
/// are the parts of the total and add up to it before and after. No irradiance or flux becomes
/// negative. `stitcher` holds texels that it would make negative at 0 from now on.
///
/// v of each texel changes along its normal until dot(normal, v) is its irradiance again: texels on
/// both sides have different normals. `normals`: unit, or 0 for texels whose irradiance is on other
/// normals and whose v stays.
///
/// Precondition: all have one value for each of `stitcher.texels()`.
void stitch_light(SeamStitcher& stitcher, std::span<const glm::vec3> normals,
                  std::vector<TexelLight>& total, std::vector<std::vector<TexelLight>>& layers,
                  uint32_t thread_count);

}  // namespace tetralight
