// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

// Pages of lightmaps as images for other programs. Texels hold irradiance E in the units of the
// lights, not divided by π; row 0 is at v = 0. Texels that belong to no surface are 0.

namespace tetralight {

/// Precondition of all: `page` is less than the number of pages.
[[nodiscard]] ImageF page_irradiance(const LightmapsView& lightmaps, uint32_t page);

/// The largest channel of all texels.
[[nodiscard]] float largest_irradiance(const LightmapsView& lightmaps);

/// How 8-bit RGBM pixels are decoded, r, g, b and a in [0, 1].
enum class RgbmCurve : uint8_t {
    Linear,     ///< E = range · a · rgb
    ThirdRoom,  ///< E = range · a^2.2 · linear(rgb), where rgb is sRGB-encoded
};

/// `range` of `ThirdRoom` at intensity 1 (the draft of MX_lightmap).
inline constexpr double kThirdRoomRange = 34.49;

/// Encodes irradiance up to `range`, which is above 0; more is clamped. The largest channel is
/// rounded to 1/255 of its value, or 1/65025 of the range.
[[nodiscard]] Image8 encode_rgbm(const ImageF& irradiance, float range, RgbmCurve curve);

/// The irradiance of one pixel.
[[nodiscard]] glm::vec3 decode_rgbm(std::array<uint8_t, 4> pixel, float range, RgbmCurve curve);

/// Path of a page among several: "a.exr" becomes "a_2.exr". One page keeps the path.
[[nodiscard]] std::string page_path(const std::string& path, uint32_t page, uint32_t page_count);

/// Writes one 32-bit float OpenEXR file a page, at its `page_path`.
[[nodiscard]] Status write_lightmap_exr(const std::string& path, const LightmapsView& lightmaps);

/// Writes one linear RGBM PNG a page, at its `page_path`. The text "tetralight" of each has
/// {"encoding":"rgbm","range":R}. Returns R, which is the largest irradiance.
[[nodiscard]] Result<float> write_lightmap_png(const std::string& path,
                                               const LightmapsView& lightmaps);

/// Writes a KTX 2.0 file: a 2D array of RGBA16F, one layer a page, irradiance divided by the scale
/// in RGB and coverage in alpha. The metadata "tetralight" has {"scale":S}. Returns S: 1 unless
/// some irradiance is more than a half can hold.
[[nodiscard]] Result<float> write_lightmap_ktx2(const std::string& path,
                                                const LightmapsView& lightmaps);

}  // namespace tetralight
