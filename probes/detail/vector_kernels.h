// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/detail/query_kernels.h>

// The vector code of `QueryKernels`, one file each, for the widest vectors of this processor.

namespace tetralight::detail {

void test_tetrahedra_in_vectors(const ProbeVolumeView& volume, QueryBlock& block);

void hull_weights_in_vectors(HullLanes& lanes);

void blend_in_vectors(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                      const BlendTarget& target);

}  // namespace tetralight::detail
