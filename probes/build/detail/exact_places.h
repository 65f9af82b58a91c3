// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/build/detail/lattice.h>

namespace tetralight::detail {

/// For each position its place on the lattice, moved a little so that doubles hold it exactly and
/// lines and planes along the steps are straight in exact arithmetic. A grid along the axes of
/// which that is so already comes back as it is.
///
/// Rectangular lattices with the same rotation keep common planes, for all steps and
/// origins, as long as this moves no position by more than a thousandth of the shortest step.
[[nodiscard]] std::vector<glm::dvec3> exact_places(std::span<const glm::dvec3> positions,
                                                   const Lattice& lattice);

}  // namespace tetralight::detail
