// SPDX-License-Identifier: Apache-2.0
#include "tests/portability/check_cells.h"

#include <algorithm>

#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight::portability {

bool cells_are_the_same(const ProbeVolumeView& volume) {
    const Tetrahedralization made = tetrahedralize(volume.exact_positions);
    return made.inner_cell_count == volume.info.inner_cell_count &&
           std::ranges::equal(made.cells, volume.cells);
}

}  // namespace tetralight::portability
