// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight {

struct HullRays {
    /// One a hull cell, in their order.
    std::vector<HullCellRays> cells;
    /// Fraction of the radial direction in every ray, 0..1.
    float radial_fraction = 0.0f;
};

/// Rays along which hull cells are extruded to infinity: at each hull vertex the angle-weighted
/// normal (Thürmer & Wüthrich 1998), blended with the direction from the hull's interior by the
/// smallest fraction, the same for all vertices, for which no hull cell folds over at any distance.
[[nodiscard]] HullRays make_hull_rays(std::span<const glm::dvec3> positions,
                                      const Tetrahedralization& tetrahedralization);

/// The same of hull cells alone. `axis`: that of the tetrahedralization.
[[nodiscard]] HullRays make_hull_rays(std::span<const glm::dvec3> positions,
                                      std::span<const Cell> hull_cells, Dimension dimension,
                                      const glm::dvec3& axis);

}  // namespace tetralight
