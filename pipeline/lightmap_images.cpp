// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_images.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <tetralight/bake/image/fraction_byte.h>
#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/image/write_layered_exr.h>
#include <tetralight/base/file.h>
#include <tetralight/base/half.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr float kAlphaExponent = 2.2f;

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

Image8 fractions(const ExportedTexels& values, uint32_t page) {
    const size_t count = values.page_texel_count();
    Image8 image{values.page_size, values.page_size, {}};
    image.pixels.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        glm::vec4 value = values.at(page * count + i);
        if (values.channel_count == 3) value.w = 1.0f;
        auto& pixel = image.pixels.emplace_back();
        for (int channel = 0; channel < 4; ++channel)
            pixel[static_cast<size_t>(channel)] = fraction_byte(value[channel]);
    }
    return image;
}

}  // namespace

float largest_value(const ExportedTexels& values) {
    float largest = 0.0f;
    for (size_t texel = 0; texel < values.page_texel_count() * values.page_count; ++texel) {
        const glm::vec4 value = values.at(texel);
        for (uint32_t i = 0; i < values.channel_count; ++i)
            largest = std::max(largest, value[static_cast<int>(i)]);
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

ImageF page_colors(const ExportedTexels& values, uint32_t page) {
    const size_t count = values.page_texel_count();
    ImageF image{values.page_size, values.page_size, {}};
    image.pixels.reserve(count);
    for (size_t i = 0; i < count; ++i) image.pixels.emplace_back(values.at(page * count + i));
    return image;
}

Status write_exr_pages(const std::string& path, const ExportedTexels& values) {
    constexpr const char* kNames[] = {"R", "G", "B", "A"};
    const size_t count = values.page_texel_count();
    std::vector<glm::vec4> pixels(count);
    LayeredImage image{values.page_size, values.page_size, {}, {}};
    for (uint32_t i = 0; i < values.channel_count; ++i) {
        image.channels.push_back({kNames[i], &pixels[0][static_cast<int>(i)], sizeof(glm::vec4)});
    }
    for (uint32_t page = 0; page < values.page_count; ++page) {
        for (size_t i = 0; i < count; ++i) pixels[i] = values.at(page * count + i);
        auto status =
            write_layered_exr(page_path(path, page, values.page_count), image, ExrPrecision::Float);
        if (!status) return status;
    }
    return Ok{};
}

Result<float> write_png_pages(const std::string& path, const ExportedTexels& values) {
    if (!values.is_fraction && values.channel_count == 4) {
        return Error{ErrorCode::InvalidArgument, "pack", "",
                     str_cat(path, ": a PNG holds no light in four channels; write .exr or .ktx2")};
    }
    const float largest = largest_value(values);
    const float range = values.is_fraction || largest == 0.0f ? 1.0f : largest;
    PngTexts texts;
    if (!values.is_fraction) {
        texts = {{"tetralight", str_cat(R"({"encoding":"rgbm","range":)", range, "}")}};
    }
    for (uint32_t page = 0; page < values.page_count; ++page) {
        const std::string to = page_path(path, page, values.page_count);
        const auto bytes = encode_png(
            values.is_fraction ? fractions(values, page)
                               : encode_rgbm(page_colors(values, page), range, RgbmCurve::Linear),
            texts);
        if (!bytes) return bytes.error().in(to);
        if (auto status = write_file(to, *bytes); !status) return status.error();
    }
    return range;
}

Result<float> write_ktx2_pages(const std::string& path, const ExportedTexels& values) {
    const float largest = largest_value(values);
    const float scale = largest <= kLargestHalf ? 1.0f : lightmap_scale(largest);
    std::vector<std::array<uint16_t, 4>> texels(values.page_texel_count() * values.page_count);
    for (size_t texel = 0; texel < texels.size(); ++texel) {
        const glm::vec4 value = values.at(texel);
        const bool scales_alpha = values.channel_count == 4;
        for (int i = 0; i < 4; ++i) {
            const float factor = i < 3 || scales_alpha ? scale : 1.0f;
            texels[texel][static_cast<size_t>(i)] = half_from_float_saturated(value[i] / factor);
        }
    }
    const Texture3dView layers{values.page_size, values.page_size, values.page_count,
                               TexelFormat::Rgba16Float, std::as_bytes(std::span(texels))};
    const auto status =
        write_ktx2_array(path, layers, {{"tetralight", str_cat(R"({"scale":)", scale, "}")}});
    if (!status) return status.error();
    return scale;
}

}  // namespace tetralight
