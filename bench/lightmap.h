// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// Charts, rectangles and pages of a scene: `lightmap.{charts,stretch,flipped,overlap,packing,
/// unwrap}.NAME`.
void bench_lightmap_layout(const Scene& scene, const std::string& name, const Options& options);

/// Its texels: `lightmap.{texel,rays,seams,stitched}.NAME`.
void bench_lightmap_texels(const Scene& scene, const std::string& name, const Options& options);

/// Paths that end at cached light against those that do not: `lightmap.cache_*.NAME`.
void bench_lightmap_cache(const Scene& scene, const std::string& name);

/// What the filter makes of noise, and the time to an error of 5 %: `lightmap.{filter,filter_bias,
/// filter_error_bar,time_to_5_percent}.NAME`.
void bench_lightmap_filter(const Scene& scene, const std::string& name);

/// Shadow masks against the occlusion of probes at the same places: `lightmap.shadowmask.NAME`.
void bench_shadow_mask(const Scene& scene, const std::string& name);

/// Layers against light without layers, both filtered: `lightmap.layers.NAME`.
void bench_lightmap_layers(const Scene& scene, const std::string& name);

/// What the filter changes at the edge of a contact shadow: `lightmap.filter_edge`.
void bench_contact_shadow();

/// Light on mapped normals against traced light: `lightmap.directional*.NAME`, with lights as the
/// scene has them and all baked (`NAME_baked_sun`).
void bench_lightmap_directional(const Scene& scene, const std::string& name);

/// `lightmap.dark_room` and `lightmap.sample`.
void bench_dark_room();
void bench_lightmap_samples(const Options& options);

}  // namespace tetralight::bench
