// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/light_difference.h>

#include <array>
#include <glm/geometric.hpp>

namespace tetralight {
namespace {

constexpr int kCount = kShCoefficientCount;

/// Mean of Y_i and of Y_i Y_j over the normals: E(n) = Σ E_i Y_i(n).
struct Moments {
    std::array<double, kCount> first{};
    std::array<std::array<double, kCount>, kCount> second{};

    Moments() {
        constexpr double kWeight = 1.0 / 26.0;
        for (int n = 0; n < 27; ++n) {
            if (n == 13) continue;  // the center of the cube
            const glm::vec3 normal(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            const auto basis = sh_basis(glm::normalize(normal));
            for (int i = 0; i < kCount; ++i) {
                first[i] += kWeight * basis[i];
                for (int j = 0; j < kCount; ++j) {
                    second[i][j] += kWeight * double{basis[i]} * double{basis[j]};
                }
            }
        }
    }
};

const Moments& moments() {
    static const Moments kMoments;
    return kMoments;
}

}  // namespace

double mean_square(const IrradianceSh& light) {
    const Moments& m = moments();
    double sum = 0.0;
    for (int i = 0; i < kCount; ++i) {
        glm::dvec3 row(0.0);
        for (int j = 0; j < kCount; ++j) {
            row += m.second[i][j] * glm::dvec3(light.coefficients[j]);
        }
        sum += glm::dot(row, glm::dvec3(light.coefficients[i]));
    }
    return sum / 3.0;
}

double mean_irradiance(const IrradianceSh& light) {
    const Moments& m = moments();
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kCount; ++i) sum += m.first[i] * glm::dvec3(light.coefficients[i]);
    return (sum.x + sum.y + sum.z) / 3.0;
}

}  // namespace tetralight
