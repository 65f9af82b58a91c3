// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_images.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/file.h>
#include <tetralight/base/half.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr float kAlphaExponent = 2.2f;

glm::vec3 irradiance_of(const IrradianceTexel& texel, float scale) {
    return glm::vec3(float_from_half(texel.rgb[0]), float_from_half(texel.rgb[1]),
                     float_from_half(texel.rgb[2])) *
           scale;
}

float factor_of_alpha(uint8_t alpha, RgbmCurve curve) {
    const float value = static_cast<float>(alpha) / 255.0f;
    return curve == RgbmCurve::Linear ? value : std::pow(value, kAlphaExponent);
}

/// The smallest alpha above 0 whose factor is at least `share`, which is in [0, 1].
uint8_t alpha_for(float share, RgbmCurve curve) {
    const float exact = curve == RgbmCurve::Linear ? share : std::pow(share, 1 / kAlphaExponent);
    auto alpha = static_cast<uint8_t>(std::clamp(std::floor(exact * 255.0f), 1.0f, 255.0f));
    while (alpha < 255 && factor_of_alpha(alpha, curve) < share) ++alpha;
    return alpha;
}

std::array<uint8_t, 4> rgbm_pixel(glm::vec3 share, RgbmCurve curve) {
    const uint8_t alpha = alpha_for(std::max({share.x, share.y, share.z}), curve);
    const float factor = factor_of_alpha(alpha, curve);
    std::array<uint8_t, 4> pixel{0, 0, 0, alpha};
    for (int i = 0; i < 3; ++i) {
        const float value = std::clamp(share[i] / factor, 0.0f, 1.0f);
        pixel[static_cast<size_t>(i)] = curve == RgbmCurve::Linear
                                            ? static_cast<uint8_t>(std::lround(value * 255.0f))
                                            : srgb8_from_linear(value);
    }
    return pixel;
}

}  // namespace

ImageF page_irradiance(const LightmapsView& lightmaps, uint32_t page) {
    const size_t size = lightmaps.info.page_size;
    const auto texels = lightmaps.irradiance.subspan(page * size * size, size * size);
    ImageF image{lightmaps.info.page_size, lightmaps.info.page_size, {}};
    image.pixels.reserve(texels.size());
    for (const IrradianceTexel& texel : texels)
        image.pixels.push_back(irradiance_of(texel, lightmaps.info.scale));
    return image;
}

float largest_irradiance(const LightmapsView& lightmaps) {
    float largest = 0.0f;
    for (const IrradianceTexel& texel : lightmaps.irradiance) {
        const glm::vec3 value = irradiance_of(texel, lightmaps.info.scale);
        largest = std::max({largest, value.x, value.y, value.z});
    }
    return largest;
}

Image8 encode_rgbm(const ImageF& irradiance, float range, RgbmCurve curve) {
    Image8 image{irradiance.width, irradiance.height, {}};
    image.pixels.reserve(irradiance.pixels.size());
    for (const glm::vec3& value : irradiance.pixels) {
        const glm::vec3 share = value / range;
        image.pixels.push_back(
            rgbm_pixel({std::clamp(share.x, 0.0f, 1.0f), std::clamp(share.y, 0.0f, 1.0f),
                        std::clamp(share.z, 0.0f, 1.0f)},
                       curve));
    }
    return image;
}

glm::vec3 decode_rgbm(std::array<uint8_t, 4> pixel, float range, RgbmCurve curve) {
    const float factor = range * factor_of_alpha(pixel[3], curve);
    glm::vec3 value(0.0f);
    for (int i = 0; i < 3; ++i) {
        const uint8_t code = pixel[static_cast<size_t>(i)];
        value[i] = factor * (curve == RgbmCurve::Linear ? static_cast<float>(code) / 255.0f
                                                        : linear_from_srgb8(code));
    }
    return value;
}

std::string page_path(const std::string& path, uint32_t page, uint32_t page_count) {
    if (page_count <= 1) return path;
    const size_t name = path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1;
    size_t dot = path.rfind('.');
    if (dot == std::string::npos || dot <= name) dot = path.size();
    return str_cat(path.substr(0, dot), "_", page, path.substr(dot));
}

Status write_lightmap_exr(const std::string& path, const LightmapsView& lightmaps) {
    for (uint32_t page = 0; page < lightmaps.info.page_count; ++page) {
        const auto status = write_exr(page_path(path, page, lightmaps.info.page_count),
                                      page_irradiance(lightmaps, page));
        if (!status) return status;
    }
    return Ok{};
}

Result<float> write_lightmap_png(const std::string& path, const LightmapsView& lightmaps) {
    const float largest = largest_irradiance(lightmaps);
    const float range = largest > 0.0f ? largest : 1.0f;
    const PngTexts texts{{"tetralight", str_cat(R"({"encoding":"rgbm","range":)", range, "}")}};
    for (uint32_t page = 0; page < lightmaps.info.page_count; ++page) {
        const std::string to = page_path(path, page, lightmaps.info.page_count);
        const auto bytes = encode_png(
            encode_rgbm(page_irradiance(lightmaps, page), range, RgbmCurve::Linear), texts);
        if (!bytes) return bytes.error().in(to);
        if (auto status = write_file(to, *bytes); !status) return status.error();
    }
    return range;
}

Result<float> write_lightmap_ktx2(const std::string& path, const LightmapsView& lightmaps) {
    const bool fits = largest_irradiance(lightmaps) <= kLargestHalf;
    const float scale = fits ? 1.0f : lightmaps.info.scale;
    std::vector<IrradianceTexel> texels(lightmaps.irradiance.begin(), lightmaps.irradiance.end());
    for (IrradianceTexel& texel : texels) {
        const glm::vec3 value = irradiance_of(texel, lightmaps.info.scale / scale);
        for (int i = 0; i < 3; ++i)
            texel.rgb[static_cast<size_t>(i)] = half_from_float_saturated(value[i]);
    }
    const Texture3dView layers{lightmaps.info.page_size, lightmaps.info.page_size,
                               lightmaps.info.page_count, TexelFormat::Rgba16Float,
                               std::as_bytes(std::span(texels))};
    const auto status =
        write_ktx2_array(path, layers, {{"tetralight", str_cat(R"({"scale":)", scale, "}")}});
    if (!status) return status.error();
    return scale;
}

}  // namespace tetralight
