// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Refuses a grid of more candidates than `max_count`, or than memory holds, before any of it is
/// taken. The messages say how many there would be: counts may be beyond any integer.
[[nodiscard]] Status check_candidate_count(double count, uint64_t max_count,
                                           uint64_t free_bytes = free_memory());

/// Refuses to refine a grid up to more probes than memory holds.
[[nodiscard]] Status check_refined_count(uint64_t count, uint64_t free_bytes = free_memory());

}  // namespace tetralight
