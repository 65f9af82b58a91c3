// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/rgbd.h>

#include <algorithm>
#include <cmath>

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

/// Code / 255 to the power, for all 8-bit codes.
const std::array<float, 256>& powers_of_codes() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> powers{};
        for (size_t code = 0; code < powers.size(); ++code)
            powers[code] = std::pow(static_cast<float>(code) / 255.0f, kRgbdExponent);
        return powers;
    }();
    return table;
}

}  // namespace

float intensity_for_rgbd(float largest_channel) {
    if (largest_channel <= kLargestRgbd) return 1.0f;
    return std::exp2(std::ceil(std::log2(largest_channel / kLargestRgbd)));
}

Image8 encode_rgbd(const ImageF& light) {
    Image8 image{light.width, light.height, {}};
    image.pixels.reserve(light.pixels.size());
    for (const glm::vec3& texel : light.pixels) image.pixels.push_back(rgbd_pixel(texel));
    return image;
}

glm::vec3 decode_rgbd(std::array<uint8_t, 4> pixel) {
    const auto& powers = powers_of_codes();
    const float alpha = std::max(static_cast<float>(pixel[3]), 1.0f);
    const glm::vec3 rgb(powers[pixel[0]], powers[pixel[1]], powers[pixel[2]]);
    return rgb * 255.0f / alpha;
}

ImageF decode_rgbd(const Image8& image) {
    ImageF light{image.width, image.height, {}};
    light.pixels.reserve(image.pixels.size());
    for (const auto& pixel : image.pixels) light.pixels.push_back(decode_rgbd(pixel));
    return light;
}

}  // namespace tetralight
