// SPDX-License-Identifier: Apache-2.0
#include "bake/project_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bake/parallel.h"
#include "bake/scene/environment.h"

namespace tetralight {
namespace {

/// Sum over one row of the sky, whose samples all have the same solid angle.
RadianceShSum environment_row(const Environment& environment, double polar_angle,
                              uint32_t columns) {
    RadianceShSum sum;
    const double y = std::cos(polar_angle), radius = std::sin(polar_angle);
    for (uint32_t column = 0; column < columns; ++column) {
        const double azimuth = 2.0 * std::numbers::pi * (column + 0.5) / columns;
        const glm::vec3 direction(radius * std::cos(azimuth), y, radius * std::sin(azimuth));
        sum.add(direction, environment_radiance(environment, direction));
    }
    return sum;
}

}  // namespace

RadianceSh project_environment(const Environment& environment, uint32_t thread_count) {
    const ImageF& image = environment.image;
    if (image.pixels.empty()) return constant_radiance(environment.radiance);
    const uint32_t split = 1 + 255 / std::min(image.width, image.height);
    const uint32_t columns = image.width * split, rows = image.height * split;
    const double row_angle = std::numbers::pi / rows;
    std::vector<RadianceShSum> row_sums(rows);
    parallel_for(rows, thread_count, [&](size_t row) {
        const double polar_angle = (static_cast<double>(row) + 0.5) * row_angle;
        row_sums[row] = environment_row(environment, polar_angle, columns);
    });
    RadianceShSum sum;
    for (uint32_t row = 0; row < rows; ++row) {
        const double height = std::cos(row * row_angle) - std::cos((row + 1) * row_angle);
        for (int i = 0; i < kShCoefficientCount; ++i) {
            sum.coefficients[i] += row_sums[row].coefficients[i] * height;
        }
    }
    return radiance_from_sum(sum, 2.0 * std::numbers::pi / columns);
}

}  // namespace tetralight
