// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/locate.h>

namespace tetralight::detail {

/// Where the walk of a query without a hint begins: a function of its position. Precondition: the
/// position is finite, and the volume has cells.
[[nodiscard]] uint32_t start_cell(const ProbeVolumeView& volume,
                                  const glm::vec3& position) noexcept;

/// Locates one position by the tests that a batch makes for it: the same answer, to the bit.
/// Preconditions: the position is finite, `start` is a cell.
[[nodiscard]] LocationTrace walk_one(const ProbeVolumeView& volume, const glm::vec3& position,
                                     uint32_t start) noexcept;

}  // namespace tetralight::detail
