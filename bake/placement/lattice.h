// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Layers of a lattice along one axis.
struct LatticeAxis {
    double first = 0.0;
    double spacing = 1.0;
    uint64_t count = 0;

    [[nodiscard]] double at(uint64_t layer) const {
        return first + static_cast<double>(layer) * spacing;
    }

    bool operator==(const LatticeAxis&) const = default;
};

/// A lattice along the world's axes.
struct Lattice {
    std::array<LatticeAxis, 3> axes;

    [[nodiscard]] uint64_t count() const { return axes[0].count * axes[1].count * axes[2].count; }

    /// Position number i: x counts fastest, then z, then y.
    [[nodiscard]] glm::dvec3 at(uint64_t i) const;

    [[nodiscard]] std::vector<glm::dvec3> positions() const;

    bool operator==(const Lattice&) const = default;
};

/// The layers of position number i, and the number of the position in these layers.
[[nodiscard]] glm::ivec3 layers_of(const Lattice& lattice, uint64_t i);
[[nodiscard]] uint64_t index_at(const Lattice& lattice, const glm::ivec3& layers);

[[nodiscard]] bool is_in(const Lattice& lattice, const glm::ivec3& layers);

/// The number of positions of `make_lattice`, which may exceed every integer type. Returns
/// invalid_argument, with the field `spacing` or `bounds`, if the spacing is not positive, or the
/// bounds are empty or not finite.
[[nodiscard]] Result<double> lattice_count(const WorldBox& bounds, const glm::dvec3& spacing);

/// A lattice centred in the bounds, half a spacing or less from their sides. An axis that is too
/// short for two layers has two, a quarter of its length from its ends, so that there is light
/// between them; a flat axis (thinner than a thousandth of the spacing) has one layer. Spacing and
/// start are rounded to exact floats, by less than 1e-6 of the farthest coordinate, so that
/// neighbors are exactly collinear and the tetrahedra between them do not degenerate.
///
/// Errors: those of `lattice_count` and `check_candidate_count`.
[[nodiscard]] Result<Lattice> make_lattice(const WorldBox& bounds, const glm::dvec3& spacing,
                                           uint64_t max_count);

}  // namespace tetralight
