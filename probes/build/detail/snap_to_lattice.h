// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace tetralight::detail {

/// If positions are part of a lattice, moves each exactly onto its place and returns the longest
/// move, metres; else leaves all as they are.
///
/// A position may be off its place by a float's step at the largest coordinate, and by a thousandth
/// of the lattice's shortest step. Holes are fine, but the 64 positions around the center must fill
/// 1/32 of the places that they span, and there must be eight or more. The moves are not much
/// longer (see `exact_places`): lines and planes of the lattice are straight in exact arithmetic
/// then, so that no tetrahedron between its positions is flat however it was turned or rounded to
/// floats.
///
/// The result does not depend on the order of the positions. Cost: O(n). Precondition: finite.
[[nodiscard]] std::optional<double> snap_to_lattice(std::span<glm::dvec3> positions);

}  // namespace tetralight::detail
