// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/probes/sh.h>

// How well sets of directions integrate the light of a sphere.

namespace tetralight::test {

using RadianceOf = std::function<float(glm::vec3)>;

/// Light above a plane and none below.
inline float edge_radiance(glm::vec3 d) {
    return d.x + 0.3f * d.y > 0.1f ? 1.0f : 0.0f;
}

/// A window of 2 % of all directions, fifty times as bright as the rest.
inline float window_radiance(glm::vec3 d) {
    return glm::dot(d, glm::normalize(glm::vec3(1, 2, 3))) > 0.96f ? 50.0f : 1.0f;
}

/// Black and white fields between `rows` parallels and twice as many meridians.
inline RadianceOf checker_radiance(int rows) {
    return [rows](glm::vec3 d) {
        constexpr float kPi = std::numbers::pi_v<float>;
        const auto steps = static_cast<float>(rows);
        const int row = static_cast<int>(std::acos(d.y) / kPi * steps);
        const int column = static_cast<int>((std::atan2(d.z, d.x) / kPi + 1.0f) * steps);
        return ((row + column) & 1) != 0 ? 1.0f : 0.0f;
    };
}

/// The rotated lattice that a probe takes as its own directions, and as many random directions.
inline std::vector<glm::vec3> rotated_lattice(uint64_t key, uint32_t count) {
    RandomStream random(key, 0);
    const glm::mat3 rotation = sample_rotation(random);
    std::vector<glm::vec3> directions = spherical_fibonacci(count);
    for (glm::vec3& d : directions) d = rotation * d;
    return directions;
}

inline std::vector<glm::vec3> random_directions(uint64_t key, uint32_t count) {
    RandomStream random(key, 1);
    std::vector<glm::vec3> directions(count);
    for (glm::vec3& d : directions) d = sample_cone({0, 0, 1}, -1.0f, random.next2());
    return directions;
}

/// Irradiance for 26 normals by one set of directions.
inline std::vector<double> irradiances(const RadianceOf& radiance,
                                       std::span<const glm::vec3> directions) {
    RadianceShSum sum;
    for (const glm::vec3& d : directions) sum.add(d, glm::vec3(radiance(d)));
    const auto weight = 4.0 * std::numbers::pi / static_cast<double>(directions.size());
    const IrradianceSh light = irradiance_from_radiance(radiance_from_sum(sum, weight));
    std::vector<double> result;
    for (int i = 0; i < 27; ++i) {
        const glm::vec3 n(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (i != 13) result.push_back(evaluate_irradiance(light, glm::normalize(n)).x);
    }
    return result;
}

/// Relative RMSE of irradiance over 26 normals and many sets of `count` directions.
inline double direction_error(
    const RadianceOf& radiance, uint32_t count,
    const std::function<std::vector<glm::vec3>(uint64_t, uint32_t)>& make_directions) {
    constexpr uint64_t kTrials = 200;
    const auto exact = irradiances(radiance, spherical_fibonacci(1 << 18));
    double error = 0.0, scale = 0.0;
    for (uint64_t trial = 0; trial < kTrials; ++trial) {
        const auto actual = irradiances(radiance, make_directions(trial, count));
        for (size_t i = 0; i < exact.size(); ++i) {
            error += (actual[i] - exact[i]) * (actual[i] - exact[i]);
            scale += exact[i] * exact[i];
        }
    }
    return std::sqrt(error / scale);
}

}  // namespace tetralight::test
