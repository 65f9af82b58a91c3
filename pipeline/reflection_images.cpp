// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reflection_images.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {
namespace {

constexpr float kRgbdExponent = 2.2f;

std::array<uint8_t, 4> rgbd_pixel(glm::vec3 light) {
    const float largest = std::max({light.x, light.y, light.z, 1.0f});
    const float alpha = std::max(std::floor(255.0f / largest), 1.0f);
    std::array<uint8_t, 4> pixel{0, 0, 0, static_cast<uint8_t>(alpha)};
    for (int i = 0; i < 3; ++i) {
        const float value = std::clamp(light[i] * alpha / 255.0f, 0.0f, 1.0f);
        pixel[static_cast<size_t>(i)] =
            static_cast<uint8_t>(std::lround(255.0f * std::pow(value, 1.0f / kRgbdExponent)));
    }
    return pixel;
}

}  // namespace

ImageF cube_strip(const ReflectionsView& reflections, size_t probe, uint32_t level) {
    const uint32_t size = reflections.size >> level;
    const size_t count = size_t{kCubeFaceCount} * size * size;
    ImageF image{size, size * kCubeFaceCount, {}};
    image.pixels.reserve(count);
    for (const RadianceTexel& texel : reflections.levels[level].subspan(probe * count, count)) {
        image.pixels.emplace_back(float_from_half(texel[0]), float_from_half(texel[1]),
                                  float_from_half(texel[2]));
    }
    return image;
}

Image8 encode_rgbd(const ImageF& light) {
    Image8 image{light.width, light.height, {}};
    image.pixels.reserve(light.pixels.size());
    for (const glm::vec3& texel : light.pixels) image.pixels.push_back(rgbd_pixel(texel));
    return image;
}

glm::vec3 decode_rgbd(std::array<uint8_t, 4> pixel) {
    glm::vec3 light(0.0f);
    for (int i = 0; i < 3; ++i) {
        const float code = static_cast<float>(pixel[static_cast<size_t>(i)]) / 255.0f;
        light[i] = std::pow(code, kRgbdExponent) * 255.0f / static_cast<float>(pixel[3]);
    }
    return light;
}

}  // namespace tetralight
