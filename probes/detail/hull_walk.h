// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/detail/query_kernels.h>

namespace tetralight::detail {

/// Walks the unresolved queries of a block over the hull cells of a volume of dimension Space,
/// several at a time. Queries that return to inner cells, or need the general code, stay
/// unresolved.
void walk_hull(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block);

}  // namespace tetralight::detail
