// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/environment.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tetralight {
namespace {

/// Bilinear lookup that wraps around horizontally and ends at the poles.
glm::vec3 sample_equirectangular(const ImageF& image, float u, float v) {
    const float x = u * static_cast<float>(image.width) - 0.5f;
    const float y = v * static_cast<float>(image.height) - 0.5f;
    const auto left = static_cast<int64_t>(std::floor(x));
    const auto top = static_cast<int64_t>(std::floor(y));
    const auto pixel = [&image](int64_t column, int64_t row) {
        const int64_t width = image.width;  // columns are up to one period outside
        const int64_t inside_column =
            column < 0 ? column + width : (column < width ? column : column - width);
        const auto inside_row = std::clamp<int64_t>(row, 0, int64_t{image.height} - 1);
        return image.pixels[static_cast<size_t>(inside_row * width + inside_column)];
    };
    const float right_weight = x - std::floor(x);
    const float lower_weight = y - std::floor(y);
    const glm::vec3 upper =
        pixel(left, top) * (1.0f - right_weight) + pixel(left + 1, top) * right_weight;
    const glm::vec3 lower =
        pixel(left, top + 1) * (1.0f - right_weight) + pixel(left + 1, top + 1) * right_weight;
    return upper * (1.0f - lower_weight) + lower * lower_weight;
}

}  // namespace

glm::vec3 rotated_about_y(glm::vec3 direction, float angle_radians) {
    const float cosine = std::cos(angle_radians);
    const float sine = std::sin(angle_radians);
    return {cosine * direction.x + sine * direction.z, direction.y,
            cosine * direction.z - sine * direction.x};
}

glm::vec3 environment_radiance(const Environment& environment, glm::vec3 direction) {
    if (environment.image.pixels.empty()) return environment.radiance;
    constexpr float kPi = std::numbers::pi_v<float>;
    const glm::vec3 d = rotated_about_y(direction, -environment.rotation_radians);
    const float u = 0.5f + std::atan2(d.z, d.x) / (2.0f * kPi);
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi;
    return environment.radiance * sample_equirectangular(environment.image, u, v);
}

}  // namespace tetralight
