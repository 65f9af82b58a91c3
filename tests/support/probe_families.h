// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "tests/support/random_probes.h"

namespace tetralight::test {

/// A kind of probe set that has broken other probe systems.
struct ProbeFamily {
    std::string name;
    std::function<std::vector<glm::dvec3>(uint64_t seed)> make;
};

inline std::vector<glm::dvec3> lattice(int side, double jitter, uint64_t seed) {
    std::vector<glm::dvec3> positions =
        random_positions(static_cast<size_t>(side * side * side), seed, jitter);
    for (int i = 0; i < side * side * side; ++i) {
        positions[static_cast<size_t>(i)] += glm::dvec3(i % side, i / side % side, i / side / side);
    }
    return positions;
}

inline std::vector<glm::dvec3> moved(std::vector<glm::dvec3> positions, const glm::dvec3& scale,
                                     const glm::dvec3& offset) {
    for (glm::dvec3& p : positions) p = p * scale + offset;
    return positions;
}

inline std::vector<glm::dvec3> turned(std::vector<glm::dvec3> positions, double angle) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(1, 2, 3));
    for (glm::dvec3& p : positions) p = glm::dvec3(turn * glm::dvec4(p, 1.0));
    return positions;
}

inline std::vector<glm::dvec3> joined(std::vector<glm::dvec3> a, const std::vector<glm::dvec3>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// What is left when a share of the positions is taken out at random.
inline std::vector<glm::dvec3> with_holes(const std::vector<glm::dvec3>& positions, double share,
                                          uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::bernoulli_distribution is_hole(share);
    std::vector<glm::dvec3> left;
    for (const glm::dvec3& p : positions) {
        if (!is_hole(engine)) left.push_back(p);
    }
    return left;
}

/// Two clusters with a spacing of centimetres, a kilometre apart.
inline std::vector<glm::dvec3> far_clusters(uint64_t seed) {
    return joined(random_positions(200, seed, 0.05),
                  moved(random_positions(200, seed + 1, 0.05), glm::dvec3(1), {1000, 300, -200}));
}

/// Pairs two metres apart over 1000 × 1000 × 100 m.
inline std::vector<glm::dvec3> wide_pairs(uint64_t seed) {
    const auto low = moved(random_positions(200, seed), {500, 500, 50}, glm::dvec3(0));
    return joined(low, moved(low, glm::dvec3(1), {0, 2, 0}));
}

inline std::vector<glm::dvec3> on_a_sphere(uint64_t seed) {
    std::vector<glm::dvec3> positions = random_positions(300, seed);
    for (glm::dvec3& p : positions) p = glm::normalize(p);
    return positions;
}

/// Every probe again, a little away.
inline std::vector<glm::dvec3> near_duplicates(uint64_t seed, double distance) {
    const auto positions = random_positions(150, seed);
    return joined(positions, moved(positions, glm::dvec3(1), {distance, 0, 0}));
}

inline std::vector<ProbeFamily> probe_families() {
    using P = std::vector<glm::dvec3>;
    return {
        {"random", [](uint64_t s) { return random_positions(500, s); }},
        {"far clusters", far_clusters},
        {"lattice", [](uint64_t) { return lattice(8, 0.0, 0); }},
        {"turned lattice",
         [](uint64_t s) { return turned(lattice(8, 0.0, 0), 0.1 + static_cast<double>(s)); }},
        {"lattice with holes",
         [](uint64_t s) {
             return turned(with_holes(lattice(8, 0.0, 0), 0.3, s), static_cast<double>(s));
         }},
        {"jittered lattice", [](uint64_t s) { return lattice(8, 1e-6, s); }},
        {"outlier",
         [](uint64_t s) {
             return joined(random_positions(300, s), {{4e4, 1e4, -3e4}});
         }},
        {"wide pairs", wide_pairs},
        {"sphere", on_a_sphere},
        {"plane",
         [](uint64_t s) {
             return turned(moved(random_positions(200, s), {1, 1, 0}, {}), 1.0);
         }},
        {"flat lattice",
         [](uint64_t) {
             return turned(moved(lattice(6, 0.0, 0), {1, 1, 0}, {}), 2.0);
         }},
        {"line",
         [](uint64_t s) {
             return turned(moved(random_positions(50, s), {1, 0, 0}, {}), 1.0);
         }},
        {"one", [](uint64_t s) { return random_positions(1, s); }},
        {"two", [](uint64_t s) { return random_positions(2, s); }},
        {"three", [](uint64_t s) { return random_positions(3, s); }},
        {"four", [](uint64_t s) { return random_positions(4, s); }},
        {"five", [](uint64_t s) { return random_positions(5, s); }},
        {"duplicates", [](uint64_t s) { return near_duplicates(s, 0.0); }},
        {"duplicates 1e-7", [](uint64_t s) { return near_duplicates(s, 1e-7); }},
        {"duplicates 1e-4", [](uint64_t s) { return near_duplicates(s, 1e-4); }},
        {"negative",
         [](uint64_t s) {
             return moved(random_positions(300, s), glm::dvec3(1), glm::dvec3(-50));
         }},
        {"far",
         [](uint64_t s) {
             return moved(random_positions(300, s), glm::dvec3(1), {1e5, -1e5, 1e5});
         }},
        {"tiny", [](uint64_t s) { return moved(random_positions(300, s), glm::dvec3(1e-6), {}); }},
        {"nearly flat",
         [](uint64_t s) {
             return moved(random_positions(300, s), {1, 1, 1e-4}, {});
         }},
        {"needle",
         [](uint64_t s) {
             return P(moved(random_positions(300, s), {1, 1e-3, 1e-3}, {}));
         }},
    };
}

}  // namespace tetralight::test
