// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/environment_sampler.h>
#include <tetralight/bake/scene/environment.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace tetralight {
namespace {

/// The minimum weight of a texel, as a fraction of its own light.
constexpr double kMinWeight = 1.0 / 16.0;

/// Cosine of the polar angle at the upper edge of a row.
double row_top(uint32_t row, uint32_t height) {
    return std::cos(std::numbers::pi * row / height);
}

/// Integral of the bilinear lookup over each texel. Per axis, each neighbor has the weight 1/8 and
/// the texel itself 3/4.
std::vector<double> texel_integrals(const Environment& environment) {
    const ImageF& image = environment.image;
    const glm::dvec3 scale(environment.radiance);
    const uint32_t width = image.width, height = image.height;
    const auto value = [&](uint32_t column, uint32_t row) {
        const glm::dvec3 c = glm::dvec3(image.pixels[size_t{row} * width + column]) * scale;
        return std::max(0.0, c.r + c.g + c.b);
    };
    std::vector<double> integrals(image.pixels.size());
    for (uint32_t row = 0; row < height; ++row) {
        const uint32_t rows[] = {row == 0 ? 0 : row - 1, row, std::min(row + 1, height - 1)};
        for (uint32_t column = 0; column < width; ++column) {
            const uint32_t columns[] = {(column + width - 1) % width, column, (column + 1) % width};
            double sum = 0.0;
            for (int i = 0; i < 9; ++i) {
                const double weight = (i % 3 == 1 ? 0.75 : 0.125) * (i / 3 == 1 ? 0.75 : 0.125);
                sum += weight * value(columns[i % 3], rows[i / 3]);
            }
            integrals[size_t{row} * width + column] = sum;
        }
    }
    return integrals;
}

/// Writes the cumulative distribution of the weights, which ends with 1, and returns their sum. The
/// last positive weight already reaches 1, so that no zero weight after it is sampled.
double cumulate(std::span<const double> weights, std::span<float> ends) {
    double sum = 0.0, end = 0.0;
    for (const double weight : weights) sum += weight;
    for (size_t i = 0; i < weights.size(); ++i) {
        end += weights[i];
        ends[i] = sum > 0.0 && end < sum ? static_cast<float>(end / sum) : 1.0f;
    }
    return sum;
}

/// The interval that contains `u`, and the position in it, in [0, 1].
std::pair<uint32_t, float> find_interval(std::span<const float> ends, float u) {
    const auto it = std::upper_bound(ends.begin(), ends.end(), u);
    const auto i = static_cast<uint32_t>(std::min(it, ends.end() - 1) - ends.begin());
    const float begin = i == 0 ? 0.0f : ends[i - 1];
    const float width = ends[i] - begin;
    return {i, width > 0.0f ? std::clamp((u - begin) / width, 0.0f, 1.0f) : 0.5f};
}

float probability_of(std::span<const float> ends, uint32_t i) {
    return ends[i] - (i == 0 ? 0.0f : ends[i - 1]);
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Environment& environment)
    : width_(environment.image.width),
      height_(environment.image.height),
      rotation_radians_(environment.rotation_radians) {
    if (environment.image.pixels.empty()) return;
    std::vector<double> weights = texel_integrals(environment);
    std::vector<double> solid_angles(height_);  // of a texel in each row, relative
    double mean = 0.0;
    for (uint32_t row = 0; row < height_; ++row) {
        solid_angles[row] = row_top(row, height_) - row_top(row + 1, height_);
        for (uint32_t column = 0; column < width_; ++column) {
            mean += weights[size_t{row} * width_ + column] * solid_angles[row];
        }
    }
    mean /= 2.0 * width_;
    if (!(mean > 0.0)) return;
    for (double& weight : weights) weight = std::max(weight - mean, kMinWeight * weight);

    std::vector<double> row_weights(height_);
    column_ends_.resize(weights.size());
    for (uint32_t row = 0; row < height_; ++row) {
        const size_t first = size_t{row} * width_;
        row_weights[row] =
            solid_angles[row] * cumulate(std::span(weights).subspan(first, width_),
                                         std::span(column_ends_).subspan(first, width_));
    }
    row_ends_.resize(height_);
    cumulate(row_weights, row_ends_);
}

float EnvironmentSampler::texel_pdf(uint32_t column, uint32_t row) const noexcept {
    const std::span<const float> columns(&column_ends_[size_t{row} * width_], width_);
    const double probability =
        static_cast<double>(probability_of(row_ends_, row)) * probability_of(columns, column);
    const double solid_angle =
        2.0 * std::numbers::pi / width_ * (row_top(row, height_) - row_top(row + 1, height_));
    return static_cast<float>(probability / solid_angle);
}

glm::vec3 EnvironmentSampler::sample(glm::vec2 u) const noexcept {
    const auto [row, down] = find_interval(row_ends_, u.y);
    const std::span<const float> columns(&column_ends_[size_t{row} * width_], width_);
    const auto [column, right] = find_interval(columns, u.x);
    const double top = row_top(row, height_), bottom = row_top(row + 1, height_);
    const double y = top + down * (bottom - top);
    const double radius = std::sqrt(std::max(0.0, 1.0 - y * y));
    const double azimuth =
        2.0 * std::numbers::pi * ((column + static_cast<double>(right)) / width_ - 0.5);
    return rotated_about_y({radius * std::cos(azimuth), y, radius * std::sin(azimuth)},
                           rotation_radians_);
}

float EnvironmentSampler::pdf(glm::vec3 direction) const noexcept {
    if (is_empty()) return 0.0f;
    const glm::vec3 d = rotated_about_y(direction, -rotation_radians_);
    const float u = 0.5f + std::atan2(d.z, d.x) / (2.0f * std::numbers::pi_v<float>);
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / std::numbers::pi_v<float>;
    const auto column = static_cast<uint32_t>(u * static_cast<float>(width_));
    const auto row = static_cast<uint32_t>(v * static_cast<float>(height_));
    return texel_pdf(std::min(column, width_ - 1), std::min(row, height_ - 1));
}

}  // namespace tetralight
