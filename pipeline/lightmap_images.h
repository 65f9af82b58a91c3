// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/pipeline/exported_texels.h>

// Pages of lightmaps as images for other programs. Irradiance E is in the units of the lights, not
// divided by π; row 0 is at v = 0. The light of texels that belong to no surface is 0.

namespace tetralight {

/// The largest channel of all texels; alpha counts if there are four.
[[nodiscard]] float largest_value(const ExportedTexels& values);

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

/// The first three channels of a page. Precondition: the page exists.
[[nodiscard]] ImageF page_colors(const ExportedTexels& values, uint32_t page);

/// Writes one OpenEXR file of 32-bit floats a page with ZIP compression, at its `page_path`.
[[nodiscard]] Status write_exr_pages(const std::string& path, const ExportedTexels& values);

/// Writes one PNG a page, at its `page_path`: fractions times 255; other values as linear RGBM with
/// the text "tetralight" {"encoding":"rgbm","range":R}. Returns R, the largest value; 1 for
/// fractions. Returns invalid_argument for four channels that are not fractions.
[[nodiscard]] Result<float> write_png_pages(const std::string& path, const ExportedTexels& values);

/// Writes a KTX 2.0 file: a 2D array of RGBA16F, one layer a page, values divided by the scale. The
/// alpha of three channels is not scaled: coverage, or 1. The metadata "tetralight" has
/// {"scale":S}. Returns S: 1 unless some value is more than a half can hold.
[[nodiscard]] Result<float> write_ktx2_pages(const std::string& path, const ExportedTexels& values);

}  // namespace tetralight
