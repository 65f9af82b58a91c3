// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Returns invalid_argument, with the field `max_probes`, if a grid has more than `max_count`
/// candidates, and out_of_resources if they do not fit into memory. `count` is a double since it
/// may exceed every integer type.
[[nodiscard]] Status check_candidate_count(double count, uint64_t max_count,
                                           uint64_t free_bytes = free_memory());

/// Returns out_of_resources if an adaptive grid with `count` probes does not fit into memory.
[[nodiscard]] Status check_refined_count(uint64_t count, uint64_t free_bytes = free_memory());

}  // namespace tetralight
