// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace tetralight::test {

/// Sets of distinct positions that are hard in one way each.
inline const char* const kPointFamilies[] = {"random",   "lattice",   "tenths",     "sphere",
                                             "clusters", "heights",   "paraboloid", "scales",
                                             "far",      "two_planes"};

inline std::vector<glm::dvec3> make_points(const std::string& family, size_t count, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::normal_distribution<double> normal;
    const auto below = [&](uint64_t limit) { return static_cast<double>(random() % limit); };
    const auto vector = [&](auto& distribution) {
        const double x = distribution(random), y = distribution(random), z = distribution(random);
        return glm::dvec3(x, y, z);
    };
    const auto point = [&]() -> glm::dvec3 {
        if (family == "lattice") return {below(9), below(9), below(9)};
        if (family == "tenths") return glm::dvec3(below(9), below(9), below(9)) * 0.1;
        if (family == "sphere") {
            const glm::dvec3 v = vector(normal);
            return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        }
        if (family == "clusters")
            return glm::dvec3(below(2), below(2), below(2)) + 1e-4 * vector(normal);
        if (family == "heights") {
            const glm::dvec3 v = vector(uniform);
            return {v.x, v.y, 0.1 * std::sin(9.0 * v.x) * std::cos(7.0 * v.y)};
        }
        if (family == "paraboloid") {
            const glm::dvec3 v = vector(uniform);
            return {v.x, v.y, v.x * v.x + v.y * v.y};
        }
        if (family == "scales") return vector(uniform) * std::exp2(below(50) - 25.0);
        if (family == "far")
            return glm::dvec3(1e5) + glm::dvec3(below(9), below(9), below(9)) * 0.3;
        if (family == "two_planes") return {below(30), below(30), below(2)};
        return vector(uniform);
    };
    std::set<std::array<double, 3>> seen;
    std::vector<glm::dvec3> points;
    for (size_t tries = 0; points.size() < count && tries < 20 * count; ++tries) {
        const glm::dvec3 p = point();
        if (seen.insert({p.x, p.y, p.z}).second) points.push_back(p);
    }
    return points;
}

}  // namespace tetralight::test
