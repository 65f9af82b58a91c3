// SPDX-License-Identifier: Apache-2.0
#include "probes/build/tetrahedralize.h"

#include "base/text.h"
#include "probes/build/detail/canonical_cells.h"
#include "probes/build/detail/cgal.h"

namespace tetralight {

Result<Tetrahedralization> tetrahedralize(std::span<const glm::dvec3> positions) {
    if (positions.empty()) return Tetrahedralization{};
    std::vector<Cell> tetrahedra = detail::delaunay_tetrahedra(positions);
    if (tetrahedra.empty()) {
        return Error{text("the ", positions.size(),
                          " probes lie in one plane: at least four that do not are needed")};
    }
    return detail::canonical_cells(std::move(tetrahedra));
}

}  // namespace tetralight
