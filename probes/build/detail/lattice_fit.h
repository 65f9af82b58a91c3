// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/build/detail/lattice.h>

namespace tetralight::detail {

/// A lattice through positions, found from a few of them outward. What it finds does not depend on
/// the order in which a call gives positions.
class LatticeFit {
  public:
    /// The lattice must be one that `first` fill well enough (see `snap_to_lattice`); one of them
    /// is 0. Precondition: they outlive the fit.
    explicit LatticeFit(std::span<const glm::dvec3> first) : first_(first) {}

    /// Makes the lattice just fine enough to have a place near every position, and moves it as near
    /// to them as it can be. False if the result is not a lattice.
    [[nodiscard]] bool fit(std::span<const glm::dvec3> positions);

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }

    /// How far any coordinate of the positions of the last fit is from that of its place.
    [[nodiscard]] double largest_error() const;

  private:
    [[nodiscard]] bool extend_to(std::span<const glm::dvec3> positions);
    [[nodiscard]] bool is_filled() const;
    [[nodiscard]] glm::dmat4 inverse_weights() const;
    void improve(const glm::dmat4& inverse_weights);
    void measure_errors(std::span<const glm::dvec3> positions);

    std::span<const glm::dvec3> first_;
    Lattice lattice_;
    std::vector<glm::dvec3> indices_;  ///< of the positions of the last fit
    std::vector<glm::dvec3> errors_;   ///< the ways from their places to them
};

}  // namespace tetralight::detail
