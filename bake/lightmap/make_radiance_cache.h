// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/lightmap/lightmap_texels.h>
#include <tetralight/bake/lightmap/texel_map.h>
#include <tetralight/bake/radiance_cache.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Samples of a texel of a cache. What a bake gathers from it is the mean of many texels.
struct RadianceCacheSettings {
    uint32_t direct_sample_count = 32;  ///< of emission, the sky and soft lights
    uint32_t path_count = 64;           ///< of reflected light
};

/// A cache that knows where texels are, and has none of their light.
[[nodiscard]] RadianceCache empty_radiance_cache(const Scene& scene, const LightmapLayout& layout,
                                                 std::span<const TexelMap> maps,
                                                 const LightmapTexels& texels);

/// Makes the cache of a bake of lightmaps: first the direct light of all texels, then their
/// reflected light, by paths that take the direct light where they hit surfaces. All lights that
/// the bake includes count, mixed ones with their direct light. Settings: the plan, the surfaces,
/// the seed and the threads. A function of the scene, the texels and the settings alone.
///
/// A texel is trusted if all its places see each other and the texels beside it: no wall crosses
/// it. Returns the errors of `TraceScene::make_static`, and cancelled if the callback returns
/// false.
[[nodiscard]] Result<RadianceCache> make_radiance_cache(
    const Scene& scene, const LightmapLayout& layout, std::span<const TexelMap> maps,
    const LightmapTexels& texels, const BakeSettings& settings,
    const RadianceCacheSettings& cache_settings = {}, const BakeCallback& callback = {});

}  // namespace tetralight
