// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight::detail {

/// Brings the inner cells of a volume into canonical order and adds one hull cell for each face
/// without a neighbor (kNoIndex). The result does not depend on the order of the cells or of their
/// vertices. Precondition: positively oriented; together they fill a convex hull.
[[nodiscard]] Tetrahedralization canonical_cells(std::vector<Cell> cells, Dimension dimension);

/// The same of inner cells that stand in canonical order already.
[[nodiscard]] Tetrahedralization with_hull_cells(std::vector<Cell> cells, Dimension dimension);

}  // namespace tetralight::detail
