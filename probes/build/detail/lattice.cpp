// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/lattice.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace tetralight::detail {
namespace {

/// What is nearer to a whole number than this counts as one.
constexpr double kNearWhole = 0.1;
constexpr int kLargestDenominator = 16;

double length_squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

bool is_near_whole(const glm::dvec3& v) {
    const glm::dvec3 off = glm::abs(v - nearest_whole(v));
    return std::max({off.x, off.y, off.z}) <= kNearWhole;
}

/// Replaces a step by its sum with others while that makes it shorter: in three dimensions the
/// result is a Minkowski-reduced basis.
bool shorten(glm::dmat3& steps, int rank, int i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    bool is_shorter = false;
    const glm::dvec3 step = steps[i];
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            if ((j >= rank && x != 0) || (k >= rank && y != 0)) continue;
            const glm::dvec3 sum =
                step + static_cast<double>(x) * steps[j] + static_cast<double>(y) * steps[k];
            if (!(length_squared(sum) < (1.0 - 1e-6) * length_squared(steps[i]))) continue;
            steps[i] = sum;
            is_shorter = true;
        }
    }
    return is_shorter;
}

void reduce(Lattice& lattice) {
    glm::dmat3 steps = lattice.steps;
    bool is_shorter = true;
    while (is_shorter) {
        is_shorter = false;
        for (int i = 0; i < lattice.rank; ++i) is_shorter |= shorten(steps, lattice.rank, i);
    }
    set_steps(lattice, steps);
}

int smallest_factor(int number) {
    int factor = 2;
    while (number % factor != 0) ++factor;
    return factor;
}

/// The remainder that is nearest to 0.
int remainder_of(int number, int divisor) {
    const int positive = (number % divisor + divisor) % divisor;
    return positive > divisor / 2 ? positive - divisor : positive;
}

/// Adds the place Σ numerators[i] / prime · steps[i]: some multiple of it is 1 / prime of one step
/// and a fraction of the others, and takes that step's part.
void divide(Lattice& lattice, const glm::ivec3& numerators, int prime) {
    int divided = 0;
    while (numerators[divided] % prime == 0) ++divided;
    int multiple = 1;
    while (remainder_of(multiple * numerators[divided] - 1, prime) != 0) ++multiple;
    glm::dvec3 step(0.0);
    for (int i = 0; i < lattice.rank; ++i) {
        const int numerator = remainder_of(multiple * numerators[i], prime);
        step += static_cast<double>(numerator) * lattice.steps[i];
    }
    lattice.steps[divided] = step / static_cast<double>(prime);
    reduce(lattice);
}

}  // namespace

bool is_near_place(const Lattice& lattice, const glm::dvec3& position) {
    if (lattice.rank == 0) return position == lattice.origin;
    const glm::dvec3 steps = lattice.inverse * (position - lattice.origin);
    const glm::dvec3 off = glm::abs(steps - whole_steps(lattice, steps));
    return std::max({off.x, off.y, off.z}) <= kNearWhole;
}

bool extend(Lattice& lattice, const glm::dvec3& position) {
    const glm::dvec3 offset = position - place_at(lattice, index_of(lattice, position));
    glm::dvec3 fraction = lattice.inverse * offset;
    for (int i = lattice.rank; i < 3; ++i) {
        if (lattice.rank > 0 && std::abs(fraction[i]) <= kNearWhole) {
            fraction[i] = 0.0;  // there is no step to divide
            continue;
        }
        lattice.steps[lattice.rank++] = offset;
        reduce(lattice);
        return true;
    }
    for (int denominator = 2; denominator <= kLargestDenominator; ++denominator) {
        const glm::dvec3 multiple = fraction * static_cast<double>(denominator);
        if (!is_near_whole(multiple)) continue;
        divide(lattice, glm::ivec3(nearest_whole(multiple)), smallest_factor(denominator));
        return true;
    }
    return false;
}

void set_steps(Lattice& lattice, const glm::dmat3& steps) {
    lattice.steps = steps;
    if (lattice.rank == 1) {
        const glm::dvec3 size = glm::abs(steps[0]);
        const int thin = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        glm::dvec3 axis(0.0);
        axis[thin] = 1.0;
        lattice.steps[1] = glm::normalize(glm::cross(steps[0], axis)) * glm::length(steps[0]);
    }
    if (lattice.rank == 1 || lattice.rank == 2) {
        const glm::dvec3 normal = glm::normalize(glm::cross(lattice.steps[0], lattice.steps[1]));
        lattice.steps[2] = normal * shortest_step(lattice);
    }
    lattice.inverse = glm::inverse(lattice.steps);
}

double shortest_step(const Lattice& lattice) {
    double shortest = glm::length(lattice.steps[0]);
    for (int i = 1; i < lattice.rank; ++i) {
        shortest = std::min(shortest, glm::length(lattice.steps[i]));
    }
    return shortest;
}

}  // namespace tetralight::detail
