// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// The places origin + i·steps[0] + j·steps[1] + k·steps[2], of `rank` independent short steps.
/// Columns beyond the rank are perpendicular to the others.
struct Lattice {
    glm::dvec3 origin{0.0};
    glm::dmat3 steps{1.0};
    glm::dmat3 inverse{1.0};  ///< of `steps`
    int rank = 0;
};

/// The largest magnitude of a component.
[[nodiscard]] inline double largest_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Rounds each component to the nearest whole number. Precondition: below 2^51. (`glm::round` calls
/// a function for each.)
[[nodiscard]] inline glm::dvec3 nearest_whole(const glm::dvec3& v) {
    constexpr double kWhole = 0x1.8p52;  // doubles around it are the whole numbers
    return (v + kWhole) - kWhole;
}

/// The whole numbers of steps nearest to some numbers of them, 0 beyond the rank.
[[nodiscard]] inline glm::dvec3 whole_steps(const Lattice& lattice, const glm::dvec3& steps) {
    glm::dvec3 whole = nearest_whole(steps);
    for (int i = lattice.rank; i < 3; ++i) whole[i] = 0.0;
    return whole;
}

/// The whole numbers of steps to the place nearest to a position.
[[nodiscard]] inline glm::dvec3 index_of(const Lattice& lattice, const glm::dvec3& position) {
    return whole_steps(lattice, lattice.inverse * (position - lattice.origin));
}

[[nodiscard]] inline glm::dvec3 place_at(const Lattice& lattice, const glm::dvec3& index) {
    return lattice.origin + lattice.steps * index;
}

/// True if a position is less than a tenth of a step from its place.
[[nodiscard]] bool is_near_place(const Lattice& lattice, const glm::dvec3& position);

/// Makes the lattice just fine enough to have a place at `position`, which has none yet: by a step
/// in a new dimension, or by dividing steps. False if that takes fractions of more than a
/// sixteenth.
[[nodiscard]] bool extend(Lattice& lattice, const glm::dvec3& position);

/// Sets the steps, and what is derived from them.
void set_steps(Lattice& lattice, const glm::dmat3& steps);

/// Length of the shortest step. Precondition: the rank is not 0.
[[nodiscard]] double shortest_step(const Lattice& lattice);

}  // namespace tetralight::detail
