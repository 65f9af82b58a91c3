// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/probe_families.h"

namespace tetralight::test {

/// A kind of probe set, of any size.
struct SizedFamily {
    std::string name;
    std::function<std::vector<glm::dvec3>(size_t count, uint64_t seed)> make;
    size_t largest = 1'000'000;
};

/// The first positions of a lattice with the spacing 1.
inline std::vector<glm::dvec3> sized_lattice(size_t count, double jitter, uint64_t seed) {
    int side = 1;
    while (static_cast<size_t>(side) * side * side < count) ++side;
    std::vector<glm::dvec3> positions = lattice(side, jitter, seed);
    positions.resize(count);
    return positions;
}

/// Clusters with a spacing of a centimetre, a kilometre apart.
inline std::vector<glm::dvec3> sized_clusters(size_t count, uint64_t seed) {
    const size_t cluster_count = 2 + seed % 3;
    const double half_size = 0.005 * std::cbrt(static_cast<double>(count) / 2.0);
    std::vector<glm::dvec3> positions = random_positions(count, seed, half_size);
    const glm::dvec3 centers[] = {{0, 0, 0}, {1000, 0, 0}, {300, 900, -100}, {500, 300, 800}};
    for (size_t i = 0; i < count; ++i) positions[i] += centers[i % cluster_count];
    return positions;
}

/// Pairs two metres apart over 1000 × 1000 × 100 m.
inline std::vector<glm::dvec3> sized_pairs(size_t count, uint64_t seed) {
    const auto low = moved(random_positions((count + 1) / 2, seed), {500, 500, 50}, {});
    auto positions = joined(low, moved(low, glm::dvec3(1), {0, 2, 0}));
    positions.resize(count);
    return positions;
}

inline std::vector<glm::dvec3> sized_sphere(size_t count, uint64_t seed) {
    std::vector<glm::dvec3> positions = random_positions(count, seed);
    for (glm::dvec3& p : positions) p = glm::normalize(p);
    return positions;
}

inline std::vector<glm::dvec3> sized_duplicates(size_t count, uint64_t seed, double distance) {
    const auto once = random_positions((count + 1) / 2, seed);
    auto positions = joined(once, moved(once, glm::dvec3(1), {distance, 0, 0}));
    positions.resize(count);
    return positions;
}

/// The families that every property must hold for.
inline std::vector<SizedFamily> sized_families() {
    const auto spread = [](glm::dvec3 scale, glm::dvec3 offset, double angle) {
        return [=](size_t n, uint64_t s) {
            return turned(moved(random_positions(n, s), scale, offset), angle);
        };
    };
    const auto twins = [](double distance) {
        return [=](size_t n, uint64_t s) { return sized_duplicates(n, s, distance); };
    };
    return {
        {"random", [](size_t n, uint64_t s) { return random_positions(n, s); }},
        {"clusters", sized_clusters},
        {"lattice", [](size_t n, uint64_t s) { return sized_lattice(n, 0.0, s); }},
        {"turned_lattice",
         [](size_t n, uint64_t s) {
             return turned(sized_lattice(n, 0.0, s), 0.1 * static_cast<double>(s % 60));
         }},
        {"jittered_lattice", [](size_t n, uint64_t s) { return sized_lattice(n, 1e-6, s); }},
        {"pairs", sized_pairs},
        {"sphere", sized_sphere},
        {"plane", spread({1, 1, 0}, {}, 1.0)},
        {"line", spread({1, 0, 0}, {}, 1.0), 5000},  // where walks pass half of all cells
        {"few", [](size_t n, uint64_t s) { return random_positions(1 + n % 5, s); }},
        {"duplicates", twins(0.0)},
        {"duplicates_1e_7", twins(1e-7)},
        {"duplicates_1e_4", twins(1e-4)},
        {"negative", spread(glm::dvec3(1), glm::dvec3(-50), 0.0)},
        {"far", spread(glm::dvec3(1), {1e5, -1e5, 1e5}, 0.0)},
        {"tiny", spread(glm::dvec3(1e-6), {}, 0.0)},
        {"nearly_flat", spread({1, 1, 1e-4}, {}, 0.0)},
        {"needle", spread({1, 1e-3, 1e-3}, {}, 0.0)},
    };
}

}  // namespace tetralight::test
