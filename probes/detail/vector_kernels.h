// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/detail/query_kernels.h>

// The vector code of `QueryKernels`, one file each, for the widest vectors of this processor.

namespace tetralight::detail {

void place_queries_in_vectors(const SeedGridHeader& grid, const VolumeInfo& info,
                              QueryBlock& block);

void begin_walks_in_vectors(const VolumeInfo& info, QueryBlock& block);

void test_tetrahedra_in_vectors(const ProbeVolumeView& volume, QueryBlock& block);

void measure_tetrahedra_in_vectors(const ProbeVolumeView& volume, const QueryBlock& block,
                                   const CellList& list, size_t begin, CellLanes& lanes);

void measure_hull_cells_in_vectors(const ProbeVolumeView& volume, const QueryBlock& block,
                                   const CellList& list, size_t begin, CellLanes& lanes);

void blend_in_vectors(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                      const BlendTarget& target);

}  // namespace tetralight::detail
