// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/project_environment.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/scene/environment.h>

namespace tetralight {
namespace {

template <size_t kCount>
using Projected = std::array<glm::dvec3, kCount>;

/// Projects the environment onto the kCount functions of `basis_of(direction)`.
template <size_t kCount, class BasisOf>
class Projection {
  public:
    Projection(const Environment& environment, BasisOf basis_of)
        : environment_(environment), basis_of_(basis_of) {
        const ImageF& image = environment.image;
        const uint32_t subdivision = 1 + 255 / std::min(image.width, image.height);
        columns_ = image.width * subdivision;
        rows_ = image.height * subdivision;
    }

    [[nodiscard]] Projected<kCount> all(uint32_t thread_count) const {
        std::vector<Projected<kCount>> row_sums(rows_);
        parallel_for(rows_, thread_count, [&](size_t i) { row_sums[i] = row(i); });
        Projected<kCount> sum{};
        const double row_angle = std::numbers::pi / rows_;
        for (uint32_t i = 0; i < rows_; ++i) {
            const double height = std::cos(i * row_angle) - std::cos((i + 1) * row_angle);
            for (size_t k = 0; k < kCount; ++k) sum[k] += row_sums[i][k] * height;
        }
        for (glm::dvec3& coefficient : sum) coefficient *= 2.0 * std::numbers::pi / columns_;
        return sum;
    }

  private:
    /// Sum over one row of the image, whose samples all have the same solid angle.
    [[nodiscard]] Projected<kCount> row(size_t index) const {
        Projected<kCount> sum{};
        const double polar_angle = (static_cast<double>(index) + 0.5) * (std::numbers::pi / rows_);
        const double y = std::cos(polar_angle), radius = std::sin(polar_angle);
        for (uint32_t column = 0; column < columns_; ++column) {
            const double azimuth = 2.0 * std::numbers::pi * (column + 0.5) / columns_;
            const glm::vec3 direction(radius * std::cos(azimuth), y, radius * std::sin(azimuth));
            const glm::dvec3 light(environment_radiance(environment_, direction));
            const auto basis = basis_of_(direction);
            for (size_t k = 0; k < kCount; ++k) sum[k] += light * static_cast<double>(basis[k]);
        }
        return sum;
    }

    const Environment& environment_;
    BasisOf basis_of_;
    uint32_t columns_ = 0;
    uint32_t rows_ = 0;
};

}  // namespace

RadianceSh project_environment(const Environment& environment, uint32_t thread_count) {
    if (environment.image.pixels.empty()) return constant_radiance(environment.radiance);
    const Projection<kShCoefficientCount, decltype(&sh_basis)> projection(environment, &sh_basis);
    const auto sum = projection.all(thread_count);
    RadianceSh radiance;
    for (size_t k = 0; k < sum.size(); ++k) radiance.coefficients[k] = glm::vec3(sum[k]);
    return radiance;
}

DistantLight project_sky(const Environment& environment, uint32_t thread_count) {
    DistantLight sky;
    if (environment.image.pixels.empty()) {
        sky.coefficients[0] = constant_radiance(environment.radiance).coefficients[0];
        return sky;
    }
    const Projection<kDistantCoefficientCount, decltype(&distant_basis)> projection(environment,
                                                                                    &distant_basis);
    const auto sum = projection.all(thread_count);
    for (size_t k = 0; k < sum.size(); ++k) sky.coefficients[k] = glm::vec3(sum[k]);
    return sky;
}

}  // namespace tetralight
