// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <tetralight/probes/detail/query_kernels.h>

namespace tetralight::detail {

/// Adds a query to the list for its first test. Local positions are in `block.tetrahedra`, at
/// places behind its end.
void begin_walk(const VolumeInfo& info, QueryBlock& block, uint32_t query) noexcept;

/// Tests one cell for each query in the lists of a block, `doubtful` excepted: it is located, or
/// goes to the list for its next test.
void run_pass(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block);

/// Tests the query at place `from` of `block.tetrahedra` in single precision; if its next cell is a
/// tetrahedron it moves to place `kept`. Returns the number of those that have been kept.
[[nodiscard]] size_t test_query(const ProbeVolumeView& volume, QueryBlock& block, size_t from,
                                size_t kept) noexcept;

}  // namespace tetralight::detail
