// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include <tetralight/probes/build/make_probe_volume.h>

namespace tetralight::test {

/// Positions uniform in the box [-1, 1]³, or whatever `scale` makes of it.
inline std::vector<glm::dvec3> random_positions(size_t count, uint64_t seed, double scale = 1.0) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> coordinate(-scale, scale);
    std::vector<glm::dvec3> positions;
    for (size_t i = 0; i < count; ++i) {
        const double x = coordinate(engine), y = coordinate(engine), z = coordinate(engine);
        positions.emplace_back(x, y, z);
    }
    return positions;
}

inline glm::vec3 random_direction(std::mt19937_64& engine) {
    std::normal_distribution<float> normal;
    const float x = normal(engine), y = normal(engine), z = normal(engine);
    return glm::normalize(glm::vec3(x, y, z));
}

/// Coefficients that are linear in the position: barycentric interpolation reproduces them.
inline IrradianceSh linear_light(const glm::dvec3& p) {
    IrradianceSh sh;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        sh.coefficients[i] = glm::vec3(0.3 + i + p.x - 0.5 * p.y, 2.0 - i * p.z, p.x + p.y + p.z);
    }
    return sh;
}

/// A volume over one group, lit by `linear_light`.
inline ProbeVolume make_lit_volume(std::vector<glm::dvec3> positions) {
    ProbeGroup group;
    group.name = "test";
    group.positions = std::move(positions);
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    for (const glm::dvec3& p : volume.exact_positions) {
        volume.irradiance.push_back(linear_light(p));
    }
    return volume;
}

}  // namespace tetralight::test
