// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <tetralight/probes/detail/query_kernels.h>
#include <tetralight/probes/detail/tetrahedron_test.h>

namespace tetralight::detail {

/// One step of a walk in a hull cell, in double. Precondition: `cell` is in range.
[[nodiscard]] CellTest test_hull_cell(const ProbeVolumeView& volume, uint32_t cell,
                                      const glm::dvec3& local) noexcept;

/// `test_hull_cell` of the first `count` queries of `block.hull_cells`. Those that go on stay in
/// the list, or move to `block.tetrahedra`.
void test_hull_cells(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block,
                     size_t count) noexcept;

}  // namespace tetralight::detail
