// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/bake_errors.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight::bench {
namespace {

/// Normals towards the faces, edges and corners of a cube.
std::vector<glm::vec3> normals() {
    std::vector<glm::vec3> result;
    for (int i = 0; i < 27; ++i) {
        const glm::vec3 n(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (i != 13) result.push_back(glm::normalize(n));
    }
    return result;
}

struct Moments {
    double error = 0.0;  ///< mean square of the difference in irradiance
    double light = 0.0;  ///< mean irradiance
};

Moments compare(const RadianceSh& a, const RadianceSh& reference) {
    static const std::vector<glm::vec3> kNormals = normals();
    const IrradianceSh ea = irradiance_from_radiance(a);
    const IrradianceSh er = irradiance_from_radiance(reference);
    Moments moments;
    const double weight = 1.0 / (3.0 * static_cast<double>(kNormals.size()));
    for (const glm::vec3& n : kNormals) {
        const glm::dvec3 light = evaluate_irradiance(er, n);
        const glm::dvec3 error = glm::dvec3(evaluate_irradiance(ea, n)) - light;
        moments.error += weight * glm::dot(error, error);
        moments.light += weight * (light.x + light.y + light.z);
    }
    return moments;
}

}  // namespace

double mean_irradiance(const RadianceSh& light) {
    return compare(light, light).light;
}

double relative_rmse(const RadianceSh& a, const RadianceSh& reference) {
    const Moments moments = compare(a, reference);
    return moments.light > 0.0 ? std::sqrt(moments.error) / moments.light : 0.0;
}

double parseval_error(const RadianceSh& a, const RadianceSh& reference) {
    const IrradianceSh light = irradiance_from_radiance(reference);
    const IrradianceSh difference = irradiance_from_radiance(a + -1.0f * reference);
    double error = 0.0, sum = 0.0;
    for (size_t i = 0; i < light.coefficients.size(); ++i) {
        const glm::dvec3 d(difference.coefficients[i]), e(light.coefficients[i]);
        error += glm::dot(d, d);
        sum += glm::dot(e, e);
    }
    return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}

}  // namespace tetralight::bench
