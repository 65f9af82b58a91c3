// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/radiance_cache.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight {

/// The pages of a bake that is under way: irradiance, rectangles and UVs, without directions,
/// layers and facts of texels. Texels have the light of their samples so far, unfiltered; those
/// without samples that of the radiance cache, if there is one (null: none) and no mixed light
/// but suns; and others that of texels around them, as in finished lightmaps. Objects without any
/// light are not covered. The metadata are {"is_preview":true}.
[[nodiscard]] Lightmaps preview_lightmaps(const Scene& scene, const PreparedLightmaps& prepared,
                                          const TexelBake& bake, const RadianceCache* cache);

}  // namespace tetralight
