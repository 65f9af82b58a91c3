// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/lightmap/lightmaps.h>

// Pages as textures: arrays of RGBA16F layers of page size, which runtime/shaders/lightmap.glsl
// samples. Their light is the value times `LightmapInfo::scale`.

namespace tetralight {

/// Four halves: the texel of an RGBA16F texture.
using TextureHalves = std::array<uint16_t, 4>;

// `irradiance` is a texture as it is: one layer a page, irradiance in RGB and coverage in alpha.
static_assert(sizeof(IrradianceTexel) == sizeof(TextureHalves));

/// The layers of the light texture, three a page: layer 3 · page + channel has v of the channel in
/// RGB and its flux in alpha. Cost: one pass over `light`.
/// Empty if `light` does not have one element a texel.
[[nodiscard]] std::vector<TextureHalves> make_light_texture(const LightmapsView& lightmaps);

}  // namespace tetralight
