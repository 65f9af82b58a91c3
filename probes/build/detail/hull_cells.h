// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Adds the hull cells of inner cells in canonical order behind them, sorted by their vertices, one
/// for each face without a neighbor (kNoIndex), and links them with their inner cells and each
/// other. A triangle begins with its smallest vertex.
void add_hull_cells(std::vector<Cell>& cells, Dimension dimension);

}  // namespace tetralight::detail
