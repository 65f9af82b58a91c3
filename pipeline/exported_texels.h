// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

// What images of lightmaps show of each texel (pipeline/lightmap_images.h).

namespace tetralight {

/// Up to four numbers a texel.
struct ExportedTexels {
    uint32_t page_size = 0;
    uint32_t page_count = 0;
    /// 3: RGB; 4: RGBA.
    uint32_t channel_count = 3;
    /// Values lie in [0, 1], so that 8 bits hold them.
    bool is_fraction = false;
    /// Of a texel in the order of the pages. May be called from many threads.
    std::function<glm::vec4(size_t texel)> at;

    [[nodiscard]] size_t page_texel_count() const { return size_t{page_size} * page_size; }
};

/// A map of lightmaps.
enum class LightmapMap : uint8_t {
    /// RGB: irradiance E; A: coverage.
    Irradiance,
    /// The dominant direction d of light in world axes, by the ratio k = min(1, 2 |u|) of light
    /// that
    /// has one, u = `mono_vector`. RGB: ½ + ½ k d; A: ½ + ½ k n0 · d of the surface's normal n0. A
    /// normal n has the light E · (½ + ½ k n · d) / A (Unity's directional mode).
    Direction,
    /// RGB: ½ + ½ u. A normal n has the light E · `mono_ratio`(u, n0, n).
    MonoSh,
    /// RGBA: how much of the light of each occlusion channel is seen.
    ShadowMask,
    /// RGB: how open the surroundings are.
    AmbientOcclusion,
};

/// The values of a map. They keep the spans of the view. Returns invalid_argument (field "map") if
/// the lightmaps do not have it; the message says how to bake it.
[[nodiscard]] Result<ExportedTexels> map_values(const LightmapsView& lightmaps, LightmapMap map);

/// One channel for each of up to four words, the others 0:
/// - the name of a layer: the luminance of its irradiance at weight 1;
/// - "light": that of all light;
/// - "sky-occlusion": that of layer "sky" over its largest value;
/// - "shadow:0" to "shadow:3": a channel of the shadow mask;
/// - "ambient-occlusion";
/// each with an exponent after it, if there is one: "sun^0.5".
/// Returns invalid_argument (field "pack") for other words and what the lightmaps do not have.
[[nodiscard]] Result<ExportedTexels> packed_values(const LightmapsView& lightmaps,
                                                   const std::vector<std::string>& words);

}  // namespace tetralight
